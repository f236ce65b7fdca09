// SPDX-License-Identifier: Apache-2.0
// Statements about bodies: zones that the arm must not enter, and parts of its tools.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "control/robot/job/near_name.h"
#include "control/robot/job/parser.h"

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
void JobParser::keepout() {
  BodyLine line;
  if (!begin_body(line, "KEEPOUT table = ")) {
    return;
  }
  const bool known = std::any_of(book_.keepouts.begin(), book_.keepouts.end(),
                                 [&](const BodyLine& each) { return each.name == line.name; });
  if (known) {
    error(tokens_[1], "there is already a zone " + in_quotes(line.name) + " to keep out of");
    return;
  }
  if (solid(line.solid) && accept("IN")) {
    const JobToken frame = take();
    body_names_.push_back({book_.keepouts.size(), book_.jobs.size() - 1, std::string(frame.text), line_, frame.column});
    line.frame = 0;
  }
  if (!failed_) {
    book_.keepouts.push_back(std::move(line));
  }
}

// Parses "BODY gripper = BOX -60 -30 0 60 30 90"; once per part of the tool
void JobParser::body() {
  BodyLine line;
  if (!begin_body(line, "BODY gripper = ") || !solid(line.solid)) {
    return;
  }
  book_.bodies.push_back(std::move(line));
}

bool JobParser::begin_body(BodyLine& line, const char* example) {
  const JobToken name = take();
  if (name.kind != JobToken::Kind::Word || !accept("=")) {
    error(name.kind != JobToken::Kind::Word ? name : peek(),
          "expected a name and '='; " + std::string(example) + kForms);
    return false;
  }
  line.name = name.text;
  line.file = job().file;
  line.place = {static_cast<int>(line_), static_cast<int>(name.column)};
  return true;
}

bool JobParser::solid(Solid& solid) {
  const JobToken start = peek();
  double at[6] = {};
  if (accept("BOX")) {
    if (!numbers(6, at, "two opposite corners of the box, x y z x y z in mm")) {
      return false;
    }
    const Vec3 one = Vec3(at[0], at[1], at[2]) / 1000;
    const Vec3 other = Vec3(at[3], at[4], at[5]) / 1000;
    solid = Solid::box((other - one).cwiseAbs(), {(one + other) / 2, Quat::Identity()});
  } else if (accept("CYLINDER")) {
    if (!numbers(6, at, "the middles of the cylinder's ends, x y z x y z in mm")) {
      return false;
    }
    const Vec3 one = Vec3(at[0], at[1], at[2]) / 1000;
    const Vec3 other = Vec3(at[3], at[4], at[5]) / 1000;
    solid = Solid::cylinder(radius(), (other - one).norm(), {(one + other) / 2, along(other - one)});
  } else if (accept("BALL")) {
    if (!numbers(3, at, "the middle of the ball, x y z in mm")) {
      return false;
    }
    solid = Solid::ball(radius(), {Vec3(at[0], at[1], at[2]) / 1000, Quat::Identity()});
  } else {
    error(start, "expected " + std::string(kForms) + "; found " + shown(start));
  }
  if (!failed_ && !(solid.half.allFinite() && solid.half.minCoeff() > 0)) {
    error(start, "a body has to have a size above 0 in all directions");
  }
  return !failed_;
}

// Radius in m; 0 if it is wrong.
double JobParser::radius() {
  double radius = 0;
  if (!accept("RADIUS")) {
    error(peek(), "expected RADIUS and a number in mm, found " + shown(peek()));
  } else if (!numbers(1, &radius, "the radius in mm")) {
    return 0;
  }
  return radius / 1000;
}

void JobParser::resolve_bodies() {
  for (const Declared& use : body_names_) {
    const auto frame = std::find_if(book_.frames.begin(), book_.frames.end(),
                                    [&](const WorkFrame& each) { return each.name == use.name; });
    if (frame == book_.frames.end()) {
      error_in(book_.jobs[use.job].file, use.line, use.column,
               no_such("frame", use.name, book_.frames, "FRAME", "POSE 500 0 100 RPY 0 0 45"));
    } else if (use.owner < book_.keepouts.size()) {
      book_.keepouts[use.owner].frame = static_cast<int>(frame - book_.frames.begin());
    }
  }
  for (BodyLine& body : book_.bodies) {
    body.tool = tool_called(body.name);
    if (body.tool < 1) {
      error_in(body.file, static_cast<std::size_t>(body.place.line), static_cast<std::size_t>(body.place.column),
               no_such("tool", body.name, book_.tools, "TOOL", "POSE 0 0 120 RPY 0 0 0"));
    }
  }
}

}  // namespace indurop::robot
