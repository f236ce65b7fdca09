// SPDX-License-Identifier: Apache-2.0
// How far an arm is from a singular position.

#pragma once

#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

// Returns the speed of the tool in the direction in which it is slowest while the axes that are not redundant_axes()
// together move with 1 rad/s (m/s), in m/s; turns of the tool count as motions of a point that is `lever` m away. 0 in
// singular positions, and with fewer than six axes. Real-time safe.
[[nodiscard]] double slowest_direction(const Arm& arm, const Joints& q, double lever) noexcept;

}  // namespace indurop::robot
