// SPDX-License-Identifier: Apache-2.0
// Statements that wait, jump and call: WAIT, GOTO and LABEL, CALL, and interrupts, "ON I4 AND I5 CALL eject", "OFF CALL
// eject".

#pragma once

#include "control/robot/job/statement.h"

namespace indurop::robot {

class FlowReader {
 public:
  explicit FlowReader(const StatementParts& parts)
      : line_(parts.line), draft_(parts.draft), names_(parts.names), expressions_(parts.expressions) {}

  void wait();
  void call();
  void jump();
  void label();
  void arm();
  void disarm();

 private:
  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
};

}  // namespace indurop::robot
