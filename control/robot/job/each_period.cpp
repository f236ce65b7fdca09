// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/each_period.h"

#include <indurop/robot/commands.h>

#include <cmath>
#include <string>
#include <string_view>

namespace indurop::robot {

// Parses "CORRECT 0, SEAM::y, SEAM::z IN seam LIMIT 20 mm RATE 50 mm/s AGE SEAM::count 100 ms", "CORRECT OFF"
void EachPeriodReader::correct() {
  draft_.add(Op::Correct);
  if (line_.accept("OFF")) {
    return;
  }
  JobCorrection correction;
  const JobToken start = line_.peek();
  correction.formula = draft_.keep(checked(expressions_.list(3, "x, y and z of the correction in mm, or OFF",
                                                             "0, SEAM::y, SEAM::z LIMIT 20 mm RATE 50 mm/s"),
                                           start));
  if (!line_.failed() && line_.accept("IN")) {
    names_.refer(JobNames::To::Frame, "frame");
  } else if (!line_.failed()) {
    correction.by_tool = line_.accept("TOOL");
  }
  if (amount(correction.limit, "LIMIT", "mm", "a correction is limited to more than 0 and at most 1000 mm") &&
      amount(correction.rate, "RATE", "mm/s", "a correction changes by more than 0 and at most 1000 mm/s")) {
    age(correction);
  }
  draft_.last().slot = static_cast<int>(draft_.book().corrections.size());
  draft_.book().corrections.push_back(correction);
}

// Parses "FOLLOW O9 = 0.02 * TIPSPEED", "FOLLOW O9 OFF"
void EachPeriodReader::follow() {
  Step step;
  step.index = expressions_.signal("the name of a variable");
  if (!line_.failed() && !line_.accept("OFF")) {
    line_.accept("=");
    const JobToken start = line_.peek();
    step.formula = draft_.keep(checked({expressions_.formula("the value that it follows, or OFF")}, start));
  }
  Step& added = draft_.add(Op::Follow);
  added.index = step.index;
  added.formula = step.formula;
}

// Parses "TRACK part ON BELT 1 ALONG conveyor", "TRACK part ON TABLE 2 ABOUT centre", "TRACK OFF"
void EachPeriodReader::track() {
  Step& step = draft_.add(Op::Track);
  if (line_.accept("OFF")) {
    return;
  }
  names_.refer(JobNames::To::Tracked, "frame");
  const bool on = !line_.failed() && line_.accept("ON");
  const bool table = on && line_.accept("TABLE");
  if (!line_.failed() && !(on && (table || line_.accept("BELT")))) {
    line_.error(line_.peek(), "expected ON BELT or ON TABLE and its number, found " + JobLine::shown(line_.peek()) +
                                  "; TRACK part ON BELT 1 ALONG conveyor, or TRACK OFF");
  }
  step.slot = table ? 1 : 0;
  const JobToken number = line_.peek();
  if (!line_.failed() && line_.numbers(1, &step.value, "the number of the belt") &&
      !(step.value >= 1 && step.value <= static_cast<double>(kBelts) && step.value == std::floor(step.value))) {
    line_.error(number, "belts have numbers from 1 to " + std::to_string(kBelts));
  }
  const char* const word = table ? "ABOUT" : "ALONG";
  if (!line_.failed() && !line_.accept(word)) {
    line_.error(line_.peek(), std::string("expected ") + word + " and the frame of the " +
                                  (table ? "table, whose z axis it turns about" : "belt, whose x axis it moves along") +
                                  ", found " + JobLine::shown(line_.peek()));
  }
  if (!line_.failed()) {
    names_.refer(JobNames::To::Origin, "frame");
  }
}

// A job that is called has other variables, so an expression that remains in use must not read any.
std::vector<Formula> EachPeriodReader::checked(std::vector<Formula> formulas, const JobToken& at) {
  for (const Formula& each : formulas) {
    if (!line_.failed() && each.reads().variables) {
      line_.error(at,
                  "this is evaluated in each period from here on, so it reads shared variables, and none of the job");
    }
  }
  return formulas;
}

bool EachPeriodReader::amount(double& to, const char* word, const char* unit, const char* wrong) {
  if (line_.failed()) {
    return false;
  }
  if (!line_.accept(word)) {
    line_.error(line_.peek(), std::string("expected ") + word + " and a number of " + unit + ", found " +
                                  JobLine::shown(line_.peek()) + "; a correction has LIMIT 20 mm and RATE 50 mm/s");
    return false;
  }
  const JobToken number = line_.peek();
  if (!line_.numbers(1, &to, unit)) {
    return false;
  }
  if (!(to > 0 && to <= 1000)) {
    line_.error(number, wrong);
    return false;
  }
  to /= 1000;
  const bool per_second = std::string_view(unit) != "mm";
  if (!line_.accept("mm") || (per_second && !(line_.accept("/") && line_.accept("s")))) {
    line_.error(line_.peek(), std::string("expected ") + unit + ", found " + JobLine::shown(line_.peek()));
  }
  return !line_.failed();
}

void EachPeriodReader::age(JobCorrection& correction) {
  if (!line_.accept("AGE")) {
    return;
  }
  correction.beat = expressions_.signal("the variable that counts the measurements");
  const JobToken time = line_.peek();
  if (!line_.failed() && line_.duration(correction.age) && !(correction.age > 0)) {
    line_.error(time, "the age of a correction is more than 0 s");
  }
}

}  // namespace indurop::robot
