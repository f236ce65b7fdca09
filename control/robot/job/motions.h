// SPDX-License-Identifier: Apache-2.0
// Statements that move the arm: motions, their offsets, and speed, zone and acceleration from here on.

#pragma once

#include "control/robot/job/statement.h"

namespace indurop::robot {

class MotionReader {
 public:
  explicit MotionReader(const StatementParts& parts)
      : line_(parts.line), draft_(parts.draft), names_(parts.names), expressions_(parts.expressions) {}

  void move(Move kind);
  void spline();
  void speed();
  void zone();
  void acceleration();

 private:
  void offset();

  JobLine& line_;
  JobDraft& draft_;
  JobNames& names_;
  ExpressionReader& expressions_;
};

}  // namespace indurop::robot
