// SPDX-License-Identifier: Apache-2.0
// Masses of tools and loads.

#include <algorithm>
#include <cmath>
#include <string>

#include "control/robot/job/parser.h"

namespace indurop::robot {

// Parses "2.5 kg CENTRE 0 0 60", "2.5 kg CENTRE 0 0 60 INERTIA 0.01 0.01 0.02 0 0 0"
void JobParser::mass(Body& body) {
  const JobToken number = peek();
  if (!numbers(1, &body.mass, "a mass, 2.5 kg")) {
    return;
  }
  if (!(body.mass > 0)) {
    error(number, "a mass is above 0 kg; LOAD 0 says that nothing is held");
    return;
  }
  if (!accept("kg")) {
    error(peek(), "expected kg, found " + shown(peek()));
    return;
  }
  if (!accept("CENTRE")) {
    error(peek(),
          "expected CENTRE and x y z of the centre of mass in mm, seen from the arm's end; found " + shown(peek()));
    return;
  }
  double centre[3];
  if (!numbers(3, centre, "x y z of the centre of mass in mm")) {
    return;
  }
  body.centre = Vec3(centre[0], centre[1], centre[2]) / 1000;
  const JobToken inertia = peek();
  double i[6];
  if (!accept("INERTIA") || !numbers(6, i, "xx yy zz xy xz yz of the inertia about the centre of mass in kg m^2")) {
    return;
  }
  body.inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  if (const std::string wrong = wrong_inertia(body.inertia); !wrong.empty()) {
    error(inertia, wrong);
  }
}

// Parses "LOAD 2.5 kg CENTRE 0 0 60", "LOAD 0"
void JobParser::load() {
  add(Op::Load).index = 0;
  if (peek().kind == JobToken::Kind::Number && peek().value == 0) {
    take();
    accept("kg");
    return;
  }
  Body body;
  mass(body);
  if (!failed_) {
    job().steps.back().index = static_cast<int>(book_.loads.size());
    book_.loads.push_back(body);
  }
}

}  // namespace indurop::robot
