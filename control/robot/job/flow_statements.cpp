// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/flow_statements.h"

#include <string>

namespace indurop::robot {

namespace {

constexpr std::size_t kMaxParts = 16;  // parts of a condition, which is evaluated in each period

}  // namespace

void FlowReader::wait() {
  if (line_.peek().kind == JobToken::Kind::Number) {
    double seconds = 0;
    if (line_.duration(seconds)) {
      draft_.add(Op::WaitTime).value = seconds;
    }
    return;
  }
  const int formula = expressions_.read("a condition");
  double timeout = 0;
  if (!line_.failed() && line_.accept("TIMEOUT")) {
    line_.duration(timeout);
  }
  Step& step = draft_.add(Op::WaitUntil);
  step.formula = formula;
  step.timeout = timeout;
}

void FlowReader::call() {
  draft_.add(Op::Call).mid = 0;
  names_.refer(JobNames::To::Job, "job");
  int count = 0;
  int first = -1;
  while (!line_.failed() && !line_.at_end()) {
    if (count > 0 && !line_.accept(",")) {
      line_.error(line_.peek(), "expected ',' and another value, found " + JobLine::shown(line_.peek()));
      break;
    }
    const int formula = expressions_.read("a value");
    first = count++ == 0 ? formula : first;
  }
  draft_.last().formula = first;
  draft_.last().mid = count;
}

void FlowReader::jump() {
  draft_.add(Op::Goto);
  names_.refer(JobNames::To::Label, "label");
}

void FlowReader::label() {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word) {
    line_.error(name, "expected the name of the label, found " + JobLine::shown(name));
    return;
  }
  names_.label(name);
}

void FlowReader::arm() {
  const JobToken start = line_.peek();
  const int formula = expressions_.read("a condition");
  const Formula& condition = draft_.book().formulas.back();
  if (!line_.failed() && (condition.reads_variables() || !condition.reads_signals())) {
    line_.error(start, "an interrupt monitors shared variables, and no variables of the job");
  } else if (!line_.failed() && condition.size() > kMaxParts) {
    line_.error(start, "this condition is too long to be watched; have a PLC program compute it");
  } else if (!line_.failed() && !line_.accept("CALL")) {
    line_.error(line_.peek(),
                "expected CALL and the name of a job, found " + JobLine::shown(line_.peek()) + "; ON I4 CALL eject");
  } else if (!line_.failed() && draft_.book().interrupts.size() >= kMaxInterrupts) {
    line_.error(line_.first(),
                "there are more than " + std::to_string(kMaxInterrupts) +
                    " ON in these jobs; have a PLC program join their conditions, or call one job for several");
  }
  Step& step = draft_.add(Op::Arm);
  step.formula = formula;
  step.mid = 0;
  step.slot = static_cast<int>(draft_.book().interrupts.size());
  if (!line_.failed()) {
    draft_.book().interrupts.push_back({formula, -1});
    names_.refer(JobNames::To::Job, "job");
  }
}

void FlowReader::disarm() {
  if (!line_.accept("CALL")) {
    line_.error(line_.peek(),
                "expected CALL and the name of a job, found " + JobLine::shown(line_.peek()) + "; OFF CALL eject");
    return;
  }
  draft_.add(Op::Disarm);
  names_.refer(JobNames::To::Job, "job");
}

}  // namespace indurop::robot
