// SPDX-License-Identifier: Apache-2.0
// Statements that wait, ask, jump, call and fail: WAIT, ASK, GOTO and LABEL, CALL, RETURN, RAISE, MESSAGE, and
// interrupts, "ON I4 AND I5 CALL eject PRIORITY 1", "OFF CALL eject".

#pragma once

#include "control/robot/job/statement.h"

namespace indurop::robot {

class FlowReader {
 public:
  explicit FlowReader(const StatementParts& parts)
      : line_(parts.line), draft_(parts.draft), names_(parts.names), expressions_(parts.expressions) {}

  void wait();
  void ask();
  // Reads the name of a job and what it gets. `result`: variable that its RETURN sets; -1: none.
  void call(int result = -1);
  void leave();
  void raise();
  void message();
  void jump();
  void label();
  void arm();
  void disarm();

 private:
  // Reads texts and numbers with commas between them. Returns the index of the text in the book.
  int text();
  void timeout(Step& step);
  void choices(JobQuestion& question);
  void range(JobQuestion& question);
  void priority();

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
};

}  // namespace indurop::robot
