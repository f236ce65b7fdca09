// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/bodies.h"

#include <algorithm>
#include <string>
#include <utility>

namespace indurop::robot {

namespace {

constexpr const char* kForms =
    "BOX x y z x y z (two opposite corners), CYLINDER x y z x y z RADIUS r (the middles of its ends) or BALL x y z "
    "RADIUS r, in mm";

// Rotation that turns z into a direction; x and y are arbitrary.
Quat along(const Vec3& direction) noexcept {
  return Quat::FromTwoVectors(Vec3::UnitZ(), direction);
}

}  // namespace

// Parses "KEEPOUT table = BOX -800 -800 -50 800 800 0", "KEEPOUT post = CYLINDER 0 700 0 0 700 900 RADIUS 60 IN cell"
void BodyReader::keepout() {
  const JobToken name = line_.peek();
  BodyLine line;
  if (!begin_body(line, "KEEPOUT table = ")) {
    return;
  }
  const bool known = std::any_of(draft_.book().keepouts.begin(), draft_.book().keepouts.end(),
                                 [&](const BodyLine& each) { return each.name == line.name; });
  if (known) {
    line_.error(name, "there is already a zone " + in_quotes(line.name) + " to keep out of");
    return;
  }
  if (solid(line.solid) && line_.accept("IN")) {
    const JobToken frame = line_.take();
    names_.declare(JobNames::In::ZoneFrame, draft_.book().keepouts.size(), frame);
    line.frame = 0;
  }
  if (!line_.failed()) {
    draft_.book().keepouts.push_back(std::move(line));
  }
}

// Parses "BODY gripper = BOX -60 -30 0 60 30 90"; once per part of the tool
void BodyReader::body() {
  BodyLine line;
  if (!begin_body(line, "BODY gripper = ") || !solid(line.solid)) {
    return;
  }
  draft_.book().bodies.push_back(std::move(line));
}

bool BodyReader::begin_body(BodyLine& line, const char* example) {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word || !line_.accept("=")) {
    line_.error(name.kind != JobToken::Kind::Word ? name : line_.peek(),
                "expected a name and '='; " + std::string(example) + kForms);
    return false;
  }
  line.name = name.text;
  line.file = line_.file();
  line.place = line_.place(name);
  return true;
}

bool BodyReader::solid(Solid& solid) {
  const JobToken start = line_.peek();
  double at[6] = {};
  if (line_.accept("BOX")) {
    if (!line_.numbers(6, at, "two opposite corners of the box, x y z x y z in mm")) {
      return false;
    }
    const Vec3 one = Vec3(at[0], at[1], at[2]) / 1000;
    const Vec3 other = Vec3(at[3], at[4], at[5]) / 1000;
    solid = Solid::box((other - one).cwiseAbs(), {(one + other) / 2, Quat::Identity()});
  } else if (line_.accept("CYLINDER")) {
    if (!line_.numbers(6, at, "the middles of the cylinder's ends, x y z x y z in mm")) {
      return false;
    }
    const Vec3 one = Vec3(at[0], at[1], at[2]) / 1000;
    const Vec3 other = Vec3(at[3], at[4], at[5]) / 1000;
    solid = Solid::cylinder(radius(), (other - one).norm(), {(one + other) / 2, along(other - one)});
  } else if (line_.accept("BALL")) {
    if (!line_.numbers(3, at, "the middle of the ball, x y z in mm")) {
      return false;
    }
    solid = Solid::ball(radius(), {Vec3(at[0], at[1], at[2]) / 1000, Quat::Identity()});
  } else {
    line_.error(start, "expected " + std::string(kForms) + "; found " + JobLine::shown(start));
  }
  if (!line_.failed() && !(solid.half.allFinite() && solid.half.minCoeff() > 0)) {
    line_.error(start, "a body has to have a size above 0 in all directions");
  }
  return !line_.failed();
}

// Radius in m; 0 if it is wrong.
double BodyReader::radius() {
  double radius = 0;
  if (!line_.accept("RADIUS")) {
    line_.error(line_.peek(), "expected RADIUS and a number in mm, found " + JobLine::shown(line_.peek()));
  } else if (!line_.numbers(1, &radius, "the radius in mm")) {
    return 0;
  }
  return radius / 1000;
}

}  // namespace indurop::robot
