// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/weaving.h"

#include <cmath>
#include <string>

namespace indurop::robot {

namespace {

constexpr double kWidest = 200;    // mm
constexpr double kLongest = 1000;  // mm
constexpr double kShortest = 0.5;  // mm

}  // namespace

// Parses "WEAVE SINE WIDTH 6 mm LENGTH 4 mm", "WEAVE TRIANGLE WIDTH 6 mm LENGTH 4 mm TURNED 30", "WEAVE OFF"
void WeaveReader::weave() {
  draft_.add(Op::Weave);
  if (line_.accept("OFF")) {
    return;
  }
  Wave wave;
  if (shape(wave) && size(wave.width, "WIDTH", kWidest) && size(wave.length, "LENGTH", kLongest)) {
    turn(wave);
  }
  draft_.last().slot = static_cast<int>(draft_.book().waves.size());
  draft_.book().waves.push_back(wave);
}

bool WeaveReader::shape(Wave& wave) {
  if (line_.accept("TRIANGLE")) {
    wave.third = Wave::kTriangle;
  } else if (line_.accept("TRAPEZOID")) {
    wave.third = Wave::kTrapezoid;
  } else if (!line_.accept("SINE")) {
    line_.error(line_.peek(), "expected SINE, TRIANGLE, TRAPEZOID or OFF, found " + JobLine::shown(line_.peek()) +
                                  "; WEAVE SINE WIDTH 6 mm LENGTH 4 mm");
  }
  return !line_.failed();
}

bool WeaveReader::size(double& to, const char* word, double most) {
  if (!line_.accept(word)) {
    line_.error(line_.peek(), std::string("expected ") + word + " and a number of mm, found " +
                                  JobLine::shown(line_.peek()) + "; WEAVE SINE WIDTH 6 mm LENGTH 4 mm");
    return false;
  }
  const JobToken number = line_.peek();
  if (!line_.numbers(1, &to, "mm")) {
    return false;
  }
  if (!(to >= kShortest && to <= most)) {
    line_.error(number, "a wave is 0.5 to 200 mm wide, from side to side, and 0.5 to 1000 mm long");
  } else if (!line_.accept("mm")) {
    line_.error(line_.peek(), "expected mm, found " + JobLine::shown(line_.peek()));
  }
  to /= 1000;
  return !line_.failed();
}

void WeaveReader::turn(Wave& wave) {
  if (!line_.accept("TURNED")) {
    return;
  }
  const JobToken number = line_.peek();
  double angle = 0;
  if (line_.numbers(1, &angle, "the angle of the wave's plane, in degrees") && !(std::abs(angle) <= 180)) {
    line_.error(number, "the plane of a wave is turned by -180 to 180 degrees");
  }
  wave.turned = radians(angle);
}

}  // namespace indurop::robot
