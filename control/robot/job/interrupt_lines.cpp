// SPDX-License-Identifier: Apache-2.0
// Statements about interrupts: "ON I4 AND I5 CALL eject", "OFF CALL eject".

#include "control/robot/job/parser.h"

namespace indurop::robot {

namespace {

constexpr std::size_t kLongest = 16;  // parts of a condition, which is evaluated in each period

}  // namespace

void JobParser::arm() {
  const JobToken start = peek();
  const int formula = expression("a condition");
  const Formula& condition = book_.formulas.back();
  if (!failed_ && (condition.looks_in() || !condition.looks_out())) {
    error(start, "an interrupt watches shared variables, and no variables of the job");
  } else if (!failed_ && condition.size() > kLongest) {
    error(start, "this condition is too long to be watched; have a PLC program compute it");
  } else if (!failed_ && !accept("CALL")) {
    error(peek(), "expected CALL and the name of a job, found " + shown(peek()) + "; ON I4 CALL eject");
  } else if (!failed_ && book_.interrupts.size() >= kMostInterrupts) {
    error(tokens_[0], "there are more than " + std::to_string(kMostInterrupts) +
                          " ON in these jobs; have a PLC program join their conditions, or call one job for several");
  }
  Step& step = add(Op::Arm);
  step.formula = formula;
  step.mid = 0;
  step.slot = static_cast<int>(book_.interrupts.size());
  if (!failed_) {
    book_.interrupts.push_back({formula, -1});
    reference(JobReference::To::Job, "job");
  }
}

void JobParser::disarm() {
  if (!accept("CALL")) {
    error(peek(), "expected CALL and the name of a job, found " + shown(peek()) + "; OFF CALL eject");
    return;
  }
  add(Op::Disarm);
  reference(JobReference::To::Job, "job");
}

}  // namespace indurop::robot
