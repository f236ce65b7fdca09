// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/motions.h"

#include <string>

#include "control/robot/path/spline.h"

namespace indurop::robot {

void MotionReader::move(Move kind) {
  draft_.add(Op::Move).move = kind;
  if (kind == Move::Circle) {
    names_.refer(JobNames::To::Mid, "point on the circle");
    line_.accept(",");
  }
  if (!line_.failed()) {
    names_.refer(JobNames::To::Target, "point");
  }
  if (!line_.failed() && line_.accept("OFFSET")) {
    offset();
  }
  if (kind == Move::Joint && !line_.failed() && line_.accept("STRAIGHT")) {
    draft_.last().value = 1;
  }
}

// Adds a step for each point of the spline.
void MotionReader::spline() {
  const JobToken start = line_.before();
  int points = 0;
  while (!line_.failed() && !line_.at_end()) {
    Step& step = draft_.add(Op::Move);
    step.move = Move::Spline;
    step.value = 1;
    names_.refer(JobNames::To::Target, "point of the spline");
    line_.accept(",");
    ++points;
  }
  if (points < 2) {
    line_.error(start, "a spline goes through two points or more; MOVL goes to one");
  } else if (points > Spline::kMaxPoints) {
    line_.error(start, "a spline of " + std::to_string(points) + " points; " + std::to_string(Spline::kMaxPoints) +
                           " is the most");
  } else {
    draft_.last().value = 0;
  }
}

// Parses "OFFSET 0, 0, 100", "OFFSET TOOL 0, 0, -50"
void MotionReader::offset() {
  const bool by_tool = line_.accept("TOOL");
  int first = -1;
  for (int i = 0; i < 3 && !line_.failed(); ++i) {
    // Without the comma "0 -50" would be one number.
    if (i > 0 && !line_.accept(",")) {
      line_.error(line_.peek(), "expected ',', found " + JobLine::shown(line_.peek()) + "; OFFSET 0, 0, -50");
      return;
    }
    const int formula = expressions_.read("x, y and z of the offset in mm");
    first = i == 0 ? formula : first;
  }
  draft_.last().formula = first;
  draft_.last().by_tool = by_tool;
}

void MotionReader::speed() {
  const JobToken number = line_.peek();
  double value = 0;
  if (!line_.numbers(1, &value, "the speed, 50% or 250 mm/s")) {
    return;
  }
  Step& step = draft_.add(Op::Speed);
  if (line_.accept("%")) {
    step.value = value / 100;
    if (!(value > 0 && value <= 100)) {
      line_.error(number, "a speed is above 0 and at most 100 %");
    }
    return;
  }
  // "mm/s" is a word followed by a sign that no other statement has.
  const bool mm = line_.accept("mm");
  const bool per_second = mm && line_.accept("/") && line_.accept("s");
  if (!per_second) {
    line_.error(line_.peek(), "expected % or mm/s, found " + JobLine::shown(line_.peek()));
    return;
  }
  step.index = 1;
  step.value = value / 1000;
  if (!(value > 0)) {
    line_.error(number, "a speed is above 0");
  }
}

void MotionReader::zone() {
  const JobToken number = line_.peek();
  double value = 0;
  if (!line_.numbers(1, &value, "the zone, 20 mm")) {
    return;
  }
  line_.accept("mm");
  draft_.add(Op::Zone).value = value / 1000;
  if (!(value >= 0 && value <= 1000)) {
    line_.error(number, "a zone is from 0 (stop at the point) to 1000 mm");
  }
}

void MotionReader::acceleration() {
  const JobToken number = line_.peek();
  double value = 0;
  if (!line_.numbers(1, &value, "the acceleration, 50%")) {
    return;
  }
  if (!line_.accept("%")) {
    line_.error(line_.peek(), "expected %, found " + JobLine::shown(line_.peek()));
    return;
  }
  draft_.add(Op::Acceleration).value = value / 100;
  if (!(value >= 1 && value <= 100)) {
    line_.error(number, "an acceleration is from 1 to 100 % of the full one");
  }
}

}  // namespace indurop::robot
