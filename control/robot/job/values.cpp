// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/values.h"

#include <algorithm>
#include <string>

namespace indurop::robot {

void ValueReader::set() {
  Step step;
  step.index = expressions_.signal("the name of a variable");
  line_.accept("=");
  step.formula = line_.failed() ? -1 : expressions_.read("ON, OFF or the value");
  add_setting(step);
}

// Parses "PULSE O8 0.2s", "PULSE O8 200 ms BEFORE 50 mm"
void ValueReader::pulse() {
  Step step;
  step.index = expressions_.signal("the name of a variable");
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
  if (wanted.formula >= 0 && draft_.book().formulas[static_cast<std::size_t>(wanted.formula)].reads_signals()) {
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
    } else if (motion->move == Move::Joint) {
      line_.error(number, "the way of a MOVJ has no distance; give a time, BEFORE 0.2s");
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

void ValueReader::variable() {
  const JobToken name = line_.take();
  int formula = -1;
  if (line_.accept("=")) {
    formula = expressions_.read("its value");  // which cannot read the variable itself
  }
  const int index = line_.failed() ? -1 : expressions_.declare(name);
  Step& step = draft_.add(Op::Assign);
  step.index = index;
  step.formula = formula >= 0 ? formula : draft_.keep(Formula::number(0));
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

void ValueReader::assign() {
  const JobToken name = line_.take();
  line_.accept("=");
  const int index = draft_.variable_called(name.text);
  if (index < 0) {
    line_.error(name, "this job has no variable " + in_quotes(name.text) + "; declare it, VAR " +
                          std::string(name.text) + " = 0, or write SET for a shared one");
  }
  const int formula = expressions_.read("its value");
  Step& step = draft_.add(Op::Assign);
  step.index = index;
  step.formula = formula;
}

}  // namespace indurop::robot
