// SPDX-License-Identifier: Apache-2.0
// A motion of a single axis as commanded, in radians or metres, within its limits.

#pragma once

#include "control/robot/path/profile.h"

namespace indurop::robot {

struct AxisOrder {
  double target = 0;  // position or velocity
  double end = 0;     // velocity to continue with; for a torque, its rate of change
  LineLimits limits, braking;
};

}  // namespace indurop::robot
