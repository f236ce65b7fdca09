// SPDX-License-Identifier: Apache-2.0
// From one place of a path to another in one posture of the arm.

#pragma once

#include "control/robot/kinematics/errors.h"
#include "control/robot/plan/draft.h"

namespace indurop::robot {

// Goes along the draft's path from `from`, where the joints are at `start`, to `to`, and writes the joint angles there
// to `q`. Adds to the draft's work. Real-time safe. Errors: Unreachable, JointLimit, Singular.
Fault walk_in_posture(const Places& places, Draft& draft, double from, const Joints& start, double to,
                      Joints& q) noexcept;

}  // namespace indurop::robot
