// SPDX-License-Identifier: Apache-2.0
// An axis that pushes for the job. Meanwhile the group stands where the axes are: it follows no path.

#pragma once

#include "control/robot/group/robot.h"
#include "control/robot/job/motion_port.h"

namespace indurop::robot {

class GroupPush {
 public:
  explicit GroupPush(Robot& robot) noexcept : robot_(robot) {}

  // Begins; all motions must have ended. Real-time safe, like all functions of this class. Errors: those of
  // MC_TorqueControl.
  Fault begin(const PushWay& way) noexcept;
  // The axis comes to rest.
  void end() noexcept;
  [[nodiscard]] PushState state() const noexcept;
  // Returns whether an axis pushes, or has not come to rest since.
  [[nodiscard]] bool on() const noexcept { return axis_ >= 0; }
  // Called once per period instead of following the path, while it is on(). Returns whether it still is.
  bool step() noexcept;

 private:
  Robot& robot_;
  int axis_ = -1;
  double pace_ = 1;
};

}  // namespace indurop::robot
