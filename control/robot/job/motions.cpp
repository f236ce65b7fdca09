// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/motions.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "control/robot/job/axis_word.h"
#include "control/robot/path/spline.h"

namespace indurop::robot {

namespace {

bool begins_extras(std::string_view word) noexcept {
  return same_word(word, "SPEED") || same_word(word, "ZONE") || same_word(word, "ACC") || same_word(word, "UNTIL") ||
         same_word(word, "AXIS") || same_word(word, "SYNC");
}

}  // namespace

void MotionReader::move(Move kind) {
  const std::size_t first = draft_.next();
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
  extras(first);
}

void MotionReader::free() {
  if (!line_.accept("FREE") || !line_.accept("TO")) {
    line_.error(line_.peek(), "a motion around obstacles is MOVE FREE TO P; others are MOVJ, MOVL, MOVC and MOVS");
    return;
  }
  move(Move::Free);
}

void MotionReader::search() {
  const JobToken start = line_.before();
  move(Move::Line);
  const MotionExtras* const extras = draft_.book().extras_of(draft_.last());
  if (!line_.failed() && (extras == nullptr || extras->until < 0)) {
    line_.error(start, "a SEARCH ends by UNTIL and a condition: SEARCH P UNTIL I4 SPEED 20 mm/s");
  }
  if (!line_.failed()) {
    draft_.book().extras.back().has_to_find = true;
    if (draft_.is_never(extras->until)) {
      line_.error(start, "the condition of this SEARCH is never true, so it always fails; MOVL goes to a point");
    }
  }
}

// Parses what may follow the points of a motion, in any order: "UNTIL I4 SPEED 20 mm/s ACC 50%". It belongs to all
// steps of the motion.
void MotionReader::extras(std::size_t first_step) {
  const bool free = draft_.last().move == Move::Free;
  MotionExtras extras;
  Step setting;
  for (bool more = true; more && !line_.failed();) {
    setting = {};
    setting.line = draft_.last().line;
    setting.column = static_cast<std::uint32_t>(line_.place(line_.peek()).column);
    more = true;
    if (line_.accept("SPEED")) {
      more = read_speed(setting);
    } else if (line_.accept("ZONE")) {
      more = read_zone(setting);
    } else if (line_.accept("ACC")) {
      more = read_acceleration(setting);
    } else if (line_.accept("AXIS")) {
      more = read_axis(extras, setting);
    } else if (line_.accept("UNTIL")) {
      until(extras);
      continue;
    } else if (line_.accept("SYNC")) {
      sync(extras);
      continue;
    } else if (free && line_.accept("SEED")) {
      seed(extras);
      continue;
    } else if (free && line_.accept("WITHIN")) {
      within(extras);
      continue;
    } else {
      break;
    }
    extras.settings.push_back(setting);
  }
  const bool zone = std::any_of(extras.settings.begin(), extras.settings.end(),
                                [](const Step& each) { return each.op == Op::Zone && each.value > 0; });
  if (!line_.failed() && zone && extras.until >= 0) {
    line_.error(line_.first(), "a motion with UNTIL ends at rest; leave its ZONE out");
  }
  if (line_.failed() || (extras.settings.empty() && extras.until < 0 && extras.sync < 0 && !free)) {
    return;
  }
  draft_.book().extras.push_back(std::move(extras));
  for (std::size_t i = first_step; i < draft_.next(); ++i) {
    draft_.step(i).slot = static_cast<int>(draft_.book().extras.size()) - 1;
  }
}

void MotionReader::until(MotionExtras& extras) {
  if (draft_.last().move == Move::Spline || extras.until >= 0) {
    line_.error(line_.before(), "UNTIL comes once, after the points of a MOVL, MOVJ, MOVC or SEARCH");
    return;
  }
  extras.until = expressions_.read("the condition that ends the motion");
}

// Parses the name after SYNC.
void MotionReader::sync(MotionExtras& extras) {
  const JobToken name = line_.peek();
  if (draft_.last().move == Move::Spline || extras.sync >= 0) {
    line_.error(line_.before(), "SYNC comes once, after the points of a MOVJ, MOVL, MOVC, SEARCH or MOVE FREE");
    return;
  }
  constexpr std::size_t kMost = string<32>::capacity();
  if (name.kind != JobToken::Kind::Word || name.text.size() > kMost) {
    line_.error(name,
                "expected a name of at most 31 characters after SYNC, the same in the jobs of all robots; found " +
                    JobLine::shown(name));
    return;
  }
  line_.take();
  std::vector<NamedVariable>& known = draft_.book().syncs;
  const auto found = std::find_if(known.begin(), known.end(), [&](const auto& each) { return each.name == name.text; });
  extras.sync = static_cast<int>(found - known.begin());
  if (found == known.end()) {
    known.push_back({std::string(name.text), line_.file(), line_.place(name)});
  }
}

void MotionReader::seed(MotionExtras& extras) {
  constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
  const JobToken number = line_.peek();
  double seed = 0;
  if (line_.numbers(1, &seed, "the seed, SEED 7") && !(seed >= 0 && seed <= kMost && seed == std::floor(seed))) {
    line_.error(number, "a seed is a whole number from 0 to 4294967295");
    return;
  }
  extras.seed = static_cast<std::uint32_t>(seed);
}

void MotionReader::within(MotionExtras& extras) {
  const JobToken number = line_.peek();
  if (line_.duration(extras.within) && !(extras.within > 0 && extras.within <= kLongestSearch)) {
    line_.error(number, "a search for a way may take up to 600 s, and more than 0");
  }
}

// Adds a step for each point of the spline.
void MotionReader::spline() {
  const JobToken start = line_.before();
  const std::size_t first = draft_.next();
  int points = 0;
  while (!line_.failed() && !line_.at_end() && !begins_extras(line_.peek().text)) {
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
    extras(first);
  }
}

// Parses "OFFSET 0, 0, 100", "OFFSET TOOL 0, 0, -50 RPY 0, 0, 90"
void MotionReader::offset() {
  const bool by_tool = line_.accept("TOOL");
  std::vector<Formula> formulas = expressions_.list(3, "x, y and z of the offset in mm", "OFFSET 0, 0, -50");
  const bool turns = !line_.failed() && line_.accept("RPY");
  if (turns) {
    std::vector<Formula> turn = expressions_.list(3, "roll, pitch and yaw in degrees", "RPY 0, 0, 90");
    std::move(turn.begin(), turn.end(), std::back_inserter(formulas));
  }
  if (line_.failed()) {
    return;
  }
  draft_.last().formula = draft_.keep(std::move(formulas));
  draft_.last().by_tool = by_tool;
  draft_.last().turns = turns;
}

void MotionReader::add(const Step& setting) {
  Step& step = draft_.add(setting.op);
  step.index = setting.index;
  step.value = setting.value;
  step.formula = setting.formula;
}

// Reads a number or an expression of numbers, or an expression, which `value` is then multiplied with.
bool MotionReader::amount(Step& step, const char* what) {
  const JobToken& then = line_.after();
  const bool ends = then.kind == JobToken::Kind::End || then.text == "%" ||
                    (then.kind == JobToken::Kind::Word && !same_word(then.text, "MOD"));
  if (line_.peek().kind == JobToken::Kind::Number && ends) {
    return line_.numbers(1, &step.value, what);
  }
  step.formula = expressions_.read(what);
  step.value = 1;
  if (const auto known = draft_.constant(step.formula); known) {
    step.value = *known;
    step.formula = -1;
  }
  return !line_.failed();
}

// A number that is written has to be in its range; what is computed is checked when it is known.
bool MotionReader::in_range(const Step& step, double low, double high, const JobToken& at, const char* wrong) {
  if (step.formula < 0 && !(step.value >= low && step.value <= high)) {
    line_.error(at, wrong);
  }
  return !line_.failed();
}

void MotionReader::speed() {
  if (Step step; read_speed(step)) {
    add(step);
  }
}

bool MotionReader::read_speed(Step& step) {
  step.op = Op::Speed;
  const JobToken number = line_.peek();
  if (!amount(step, "the speed, 50% or 250 mm/s")) {
    return false;
  }
  constexpr double kLeast = std::numeric_limits<double>::min();
  if (line_.accept("%")) {
    step.value /= 100;
    return in_range(step, kLeast, 1, number, "a speed is above 0 and at most 100 %");
  }
  // "mm/s" is a word followed by a sign that no other statement has.
  if (!line_.accept_unit("mm/s")) {
    line_.error(line_.peek(), "expected % or mm/s, found " + JobLine::shown(line_.peek()));
    return false;
  }
  step.index = 1;
  step.value /= 1000;
  return in_range(step, kLeast, HUGE_VAL, number, "a speed is above 0");
}

void MotionReader::zone() {
  if (Step step; read_zone(step)) {
    add(step);
  }
}

bool MotionReader::read_zone(Step& step) {
  step.op = Op::Zone;
  const JobToken number = line_.peek();
  if (!amount(step, "the zone, 20 mm")) {
    return false;
  }
  line_.accept("mm");
  step.value /= 1000;
  return in_range(step, 0, 1, number, "a zone is from 0 (stop at the point) to 1000 mm");
}

// Parses "3 20" of an axis that a pose leaves undetermined.
bool MotionReader::read_axis(const MotionExtras& extras, Step& step) {
  step.op = Op::Axis;
  if (const Move move = draft_.last().move; move == Move::Spline || move == Move::Free) {
    line_.error(line_.before(),
                "AXIS comes after the points of a MOVJ, MOVL, MOVC or SEARCH; for others, it is part of a POINT");
    return false;
  }
  Held given = 0;
  for (const Step& each : extras.settings) {
    given |= each.op == Op::Axis ? 1U << static_cast<unsigned>(each.index) : 0U;
  }
  step.index = axis_number(line_, shape_, given);
  if (step.index < 0) {
    return false;
  }
  if (!amount(step, "where the axis is to stand, AXIS 3 20")) {
    return false;
  }
  step.value *= shape_.slides[at(step.index)] ? 0.001 : radians(1);
  return true;
}

void MotionReader::acceleration() {
  if (Step step; read_acceleration(step)) {
    add(step);
  }
}

bool MotionReader::read_acceleration(Step& step) {
  step.op = Op::Acceleration;
  const JobToken number = line_.peek();
  if (!amount(step, "the acceleration, 50%")) {
    return false;
  }
  if (!line_.accept("%")) {
    line_.error(line_.peek(), "expected %, found " + JobLine::shown(line_.peek()));
    return false;
  }
  step.value /= 100;
  return in_range(step, 0.01, 1, number, "an acceleration is from 1 to 100 % of the full one");
}

}  // namespace indurop::robot
