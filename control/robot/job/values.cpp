// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/values.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace indurop::robot {

void ValueReader::set() {
  Step step;
  step.index = expressions_.signal("the name of a variable", ExpressionReader::Use::Set);
  line_.accept("=");
  step.formula = line_.failed() ? -1 : expressions_.read("ON, OFF or the value");
  add_setting(step);
}

// Parses "PULSE O8 0.2s", "PULSE O8 200 ms BEFORE 50 mm"
void ValueReader::pulse() {
  Step step;
  step.index = expressions_.signal("the name of a variable", ExpressionReader::Use::Set);
  const JobToken time = line_.peek();
  if (!line_.failed() && line_.duration(step.pulse) && !(step.pulse > 0)) {
    line_.error(time, "a pulse is longer than 0 s");
  }
  add_setting(step);
}

// Adds a setting that takes effect at rest, or during the motion before it.
void ValueReader::add_setting(Step step) {
  const bool before = !line_.failed() && line_.accept("BEFORE");
  if (before || (!line_.failed() && line_.accept("AFTER"))) {
    step.mid = before ? 0 : 1;
    set_on_path(step);
    return;
  }
  Step& added = draft_.add(Op::Set);
  step.op = added.op;
  step.line = added.line;
  added = step;
}

// Parses "SET O8 ON BEFORE 50 mm", "SET O8 ON AFTER 0.2s"
void ValueReader::set_on_path(Step wanted) {
  const auto& steps = draft_.job().steps;
  auto motion = steps.rbegin();
  while (motion != steps.rend() && motion->op == Op::SetOnPath) {
    ++motion;
  }
  if (motion == steps.rend() || motion->op != Op::Move) {
    line_.error(line_.first(), "BEFORE and AFTER are about the motion in the line above; there is none");
    return;
  }
  const MotionExtras* const extras = draft_.book().extras_of(*motion);
  if (extras != nullptr && extras->until >= 0) {
    line_.error(line_.first(), "a motion with UNTIL has no place known before; SET it after the motion, at rest");
    return;
  }
  if (wanted.formula >= 0 && draft_.book().formulas[static_cast<std::size_t>(wanted.formula)].reads().world()) {
    line_.error(line_.first(), "what is set on the way is computed before; it cannot read shared variables");
    return;
  }
  const JobToken number = line_.peek();
  const JobToken unit = line_.after();
  if (same_word(unit.text, "mm") && line_.numbers(1, &wanted.value, "a distance")) {
    line_.accept("mm");
    wanted.value /= 1000;
    if (!(wanted.value >= 0)) {
      line_.error(number, "a distance is from 0 mm");
    } else if (is_of_joints(motion->move)) {
      line_.error(number, "the way of a MOVJ or MOVE FREE has no distance; give a time, BEFORE 0.2s");
    }
  } else if (line_.duration(wanted.timeout)) {
    wanted.timeout = std::max(wanted.timeout, 1e-6);
  }
  if (!line_.failed()) {
    Step& step = draft_.add(Op::SetOnPath);
    wanted.op = step.op;
    wanted.line = step.line;
    step = wanted;
  }
}

void ValueReader::add_assignment(int variable, Formula value) {
  Step& step = draft_.add(Op::Assign);
  step.index = variable;
  step.formula = draft_.keep(std::move(value));
}

// Parses "VAR n = 3", "VAR a[10]", "VAR n = CALL area 3, 4"
void ValueReader::variable() {
  const JobToken name = line_.take();
  if (name.text.find('[') != std::string_view::npos) {
    array(name);
    return;
  }
  Formula value = Formula::number(0);
  if (line_.accept("=")) {
    if (line_.accept("CALL")) {
      flow_.call(expressions_.declare(name));
      return;
    }
    value = expressions_.formula("its value");  // which cannot read the variable itself
  }
  const int index = line_.failed() ? -1 : expressions_.declare(name);
  add_assignment(index, std::move(value));
}

// Parses the rest of "VAR a[3]", "VAR a[3] = 5, 7, 9"
void ValueReader::array(const JobToken& name) {
  int size = 0;
  std::vector<Formula> values;
  const bool given = line_.accept("=");
  do {
    values.push_back(given ? expressions_.formula("the value of an element") : Formula::number(0));
  } while (!line_.failed() && given && line_.accept(","));
  const int first = line_.failed() ? -1 : expressions_.declare_array(name, size);
  if (first >= 0 && given && values.size() != static_cast<std::size_t>(size)) {
    line_.error(name, "this array has " + std::to_string(size) + " elements, and here are " +
                          std::to_string(values.size()) + " values; write one for each, or none");
  }
  for (int i = 0; i < size && !line_.failed(); ++i) {
    add_assignment(first + i, given ? std::move(values[static_cast<std::size_t>(i)]) : Formula::number(0));
  }
}

void ValueReader::parameters() {
  if (!draft_.job().steps.empty() || !draft_.job().variables.empty()) {
    line_.error(line_.first(), "PARAM comes first in a job, once");
    return;
  }
  while (!line_.failed() && !line_.at_end()) {
    expressions_.declare(line_.take());
    line_.accept(",");
  }
  draft_.job().parameters = draft_.job().variables.size();
}

// Parses "part = camera : POSE x, y, 0 RPY 0, 0, turn"
void ValueReader::compute_place() {
  const JobToken name = line_.take();
  if (!line_.accept("=") || !places_.at_place()) {
    line_.error(name, "this job has no variable " + in_quotes(name.text) + "; declare it, VAR " +
                          std::string(name.text) + " = 0, or write SET for a shared one; a point or a frame gets a " +
                          "place, " + std::string(name.text) + " = POSE x, y, z RPY r, p, y");
    return;
  }
  const int place = places_.read();
  draft_.add(Op::Place).mid = place;
  names_.refer(JobNames::To::Computed, name);
}

// Parses "n = 3", "a[i] = 3", "n = CALL area 3, 4"
void ValueReader::assign() {
  if (!expressions_.at_variable()) {
    compute_place();
    return;
  }
  ExpressionReader::Place place = expressions_.place();
  if (!line_.failed() && !line_.accept("=")) {
    line_.error(line_.peek(), "expected '=', found " + JobLine::shown(line_.peek()));
  }
  if (line_.failed()) {
    return;
  }
  if (place.size == 0 && line_.accept("CALL")) {
    flow_.call(place.variable);
    return;
  }
  Formula value = expressions_.formula("its value");
  if (place.size == 0) {
    add_assignment(place.variable, std::move(value));
    return;
  }
  std::vector<Formula> both;
  both.push_back(std::move(place.element));
  both.push_back(std::move(value));
  Step& step = draft_.add(Op::Assign);
  step.index = place.variable;
  step.mid = place.size;
  step.formula = draft_.keep(std::move(both));
}

}  // namespace indurop::robot
