// SPDX-License-Identifier: Apache-2.0
// The torques of set points that were not planned: a belt or a correction has moved them from the planned path.

#pragma once

#include "control/robot/group/robot.h"

namespace indurop::robot {

// Returns whether an axis has not enough torque to be at these set points in the next period. Errors: Torque. Real-time
// safe.
[[nodiscard]] Fault too_heavy(const Robot& robot, const Joints& q) noexcept;

}  // namespace indurop::robot
