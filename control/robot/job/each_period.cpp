// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/each_period.h"

#include <indurop/robot/commands.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

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
  axes(correction);
  if (limits(correction, "; a correction has LIMIT 20 mm and RATE 50 mm/s")) {
    age(correction);
  }
  keep(correction);
}

// Parses "PRESS 20, -WRIST::fz ALONG Z TOOL MOST 60 N STIFFNESS 40 N/mm LIMIT 5 mm RATE 10 mm/s AGE WRIST::count 50
// ms", "PRESS 20, -WRIST::fz ALONG Z, 5, WRIST::fx ALONG X TOOL MOST 60 N STIFFNESS 40, 10 N/mm LIMIT ...", "PRESS OFF"
void EachPeriodReader::press() {
  static constexpr const char* kExample =
      "; PRESS 20, -WRIST::fz ALONG Z TOOL MOST 60 N STIFFNESS 40 N/mm LIMIT 5 mm RATE 10 mm/s";
  draft_.add(Op::Correct).mid = 1;
  if (line_.accept("OFF")) {
    return;
  }
  JobCorrection press;
  std::vector<Formula> forces;
  while (direction(press, forces) && line_.accept(",")) {
  }
  press.formula = draft_.keep(std::move(forces));
  axes(press);
  if (amount(press.most, {"MOST", "N", 1e5, 1, kExample}) && permitted(press) && stiffness(press, kExample) &&
      limits(press, kExample)) {
    age(press);
  }
  keep(press);
}

// Where all forces are the wanted ones, their sum is measured.
bool EachPeriodReader::permitted(const JobCorrection& press) {
  std::array<double, 2> squares{};  // of the wanted and of the measured forces that are known
  std::array<double, 2> greatest{};
  JobToken at;
  for (int i = 0; i < 2 * press.directions; ++i) {
    const double force = std::abs(draft_.constant(press.formula + i).value_or(0));
    const auto kind = static_cast<std::size_t>(i % 2);
    squares[kind] += force * force;
    if (force > greatest[kind]) {
      greatest[kind] = force;
      at.column =
          draft_.book().formulas[static_cast<std::size_t>(press.formula) + static_cast<std::size_t>(i)].column();
    }
    if (std::sqrt(squares[kind]) > press.most) {
      line_.error(at,
                  "PRESS fails above its MOST, which is less than this force; MOST has to leave some room above it");
    }
  }
  return !line_.failed();
}

// Parses "20, -WRIST::fz ALONG Z".
bool EachPeriodReader::direction(JobCorrection& press, std::vector<Formula>& forces) {
  const JobToken start = line_.peek();
  if (press.directions == static_cast<int>(press.along.size())) {
    line_.error(start, "a tool presses in three directions at most, ALONG X, Y and Z");
    return false;
  }
  for (Formula& each : checked(
           expressions_.list(2, "the force in N and the measured one, or OFF", "20, -WRIST::fz ALONG Z TOOL"), start)) {
    forces.push_back(std::move(each));
  }
  return axis(press);
}

bool EachPeriodReader::axis(JobCorrection& press) {
  static constexpr std::array<const char*, 3> kNames{"X", "Y", "Z"};
  const bool along = !line_.failed() && line_.accept("ALONG");
  const JobToken name = line_.peek();
  std::size_t found = 0;
  while (found < kNames.size() && !(along && line_.accept(kNames[found]))) {
    ++found;
  }
  if (line_.failed()) {
    return false;
  }
  if (found == kNames.size()) {
    line_.error(name,
                "expected ALONG and X, Y or Z, found " + JobLine::shown(name) + "; the tool presses along this axis");
    return false;
  }
  const std::size_t* const begin = press.along.data();
  if (std::find(begin, begin + press.directions, found) != begin + press.directions) {
    line_.error(name, std::string("the tool presses along ") + kNames[found] +
                          " already; each direction has an axis of its own");
    return false;
  }
  press.along[static_cast<std::size_t>(press.directions++)] = found;
  return true;
}

// Parses "STIFFNESS 40 N/mm" for all directions, "STIFFNESS 40, 10 N/mm" for each of them.
bool EachPeriodReader::stiffness(JobCorrection& press, const char* example) {
  const Amount wanted{"STIFFNESS", "N/mm", 1e5, 1000, example};
  if (!word(wanted)) {
    return false;
  }
  const JobToken start = line_.peek();
  int count = 0;
  do {
    double ignored = 0;
    if (!number(count < press.directions ? press.stiffness[static_cast<std::size_t>(count)] : ignored, wanted)) {
      return false;
    }
    ++count;
  } while (line_.accept(","));
  if (count == 1) {
    press.stiffness.fill(press.stiffness[0]);
  } else if (count != press.directions) {
    line_.error(start, "STIFFNESS is one number for all directions or one for each of the " +
                           std::to_string(press.directions) + ", found " + std::to_string(count));
    return false;
  }
  return unit(wanted);
}

void EachPeriodReader::axes(JobCorrection& correction) {
  if (!line_.failed() && line_.accept("IN")) {
    names_.refer(JobNames::To::Frame, "frame");
  } else if (!line_.failed()) {
    correction.by_tool = line_.accept("TOOL");
  }
}

bool EachPeriodReader::limits(JobCorrection& correction, const char* example) {
  return amount(correction.limit, {"LIMIT", "mm", 1000, 1e-3, example}) &&
         amount(correction.rate, {"RATE", "mm/s", 1000, 1e-3, example});
}

void EachPeriodReader::keep(const JobCorrection& correction) {
  draft_.last().slot = static_cast<int>(draft_.book().corrections.size());
  draft_.book().corrections.push_back(correction);
}

// Parses "FOLLOW O9 = 0.02 * TIPSPEED", "FOLLOW O9 OFF"
void EachPeriodReader::follow() {
  Step step;
  step.index = expressions_.signal("the name of a variable", ExpressionReader::Use::Set);
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

bool EachPeriodReader::amount(double& to, const Amount& wanted) {
  return word(wanted) && number(to, wanted) && unit(wanted);
}

bool EachPeriodReader::word(const Amount& wanted) {
  if (!line_.failed() && !line_.accept(wanted.word)) {
    line_.error(line_.peek(), std::string("expected ") + wanted.word + " and a number of " + wanted.unit + ", found " +
                                  JobLine::shown(line_.peek()) + wanted.example);
  }
  return !line_.failed();
}

bool EachPeriodReader::number(double& to, const Amount& wanted) {
  const JobToken at = line_.peek();
  if (!line_.numbers(1, &to, wanted.unit)) {
    return false;
  }
  if (!(to > 0 && to <= wanted.most)) {
    line_.error(at, std::string(wanted.word) + " is more than 0 and at most " +
                        std::to_string(static_cast<int>(wanted.most)) + " " + wanted.unit);
    return false;
  }
  to *= wanted.to_si;
  return true;
}

bool EachPeriodReader::unit(const Amount& wanted) {
  if (!line_.accept_unit(wanted.unit)) {
    line_.error(line_.peek(), std::string("expected ") + wanted.unit + ", found " + JobLine::shown(line_.peek()));
  }
  return !line_.failed();
}

void EachPeriodReader::age(JobCorrection& correction) {
  if (!line_.accept("AGE")) {
    return;
  }
  correction.beat = expressions_.signal("the variable that counts the measurements", ExpressionReader::Use::Read);
  const JobToken time = line_.peek();
  if (!line_.failed() && line_.duration(correction.age) && !(correction.age > 0)) {
    line_.error(time, "the age of a correction is more than 0 s");
  }
}

}  // namespace indurop::robot
