// SPDX-License-Identifier: Apache-2.0
// Says which axis has been refused or stopped because it would leave its range while it moves on its own: its report
// has only the number of the error.

#pragma once

#include <array>

#include "control/robot/group/robot.h"

namespace indurop::robot {

class RangeReport {
 public:
  explicit RangeReport(Robot& robot) noexcept : robot_(robot) {}

  // Ends a period. While the group moves or has failed, the message is that of its job. Real-time safe.
  void step() noexcept;

 private:
  Robot& robot_;
  std::array<bool, kAxes> met_{};  // in the last period
};

}  // namespace indurop::robot
