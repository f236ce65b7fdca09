// SPDX-License-Identifier: Apache-2.0
// The end of the task after one of its threads has crashed: at rest, and without power. The data that the thread wrote
// last may be corrupt; the tick has its own.

#pragma once

#include "control/robot/group/group_port.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class Breakdown {
 public:
  Breakdown(Robot& robot, GroupPort& group) noexcept : robot_(robot), group_(group) {}

  // Stops the robot; the first reason counts. Real-time safe, like all functions of this class.
  void begin(const char* what, const char* how) noexcept;
  // Sets why the task has to end once it is at rest without power. Called once per period.
  void report(Outputs& out) noexcept;

 private:
  Robot& robot_;
  GroupPort& group_;
  char why_[240] = "";
  double rested_ = 0;  // s
};

}  // namespace indurop::robot
