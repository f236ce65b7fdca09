// SPDX-License-Identifier: Apache-2.0
// The arm of examples/robot_cell with its limits, and others, for the tests.

#pragma once

#include <random>
#include <string>

#include "robot/planner.h"
#include "robot/urdf.h"

namespace indurop::robot {

std::string cell_urdf();
Arm cell_arm();
// Wrist axes that do not meet: no closed form.
Arm odd_arm();
JointLimits cell_limits();

// Somewhere within the limits, `margin` away from them. The same sequence for the same seed.
Joints anywhere(const Arm& arm, std::mt19937& random, double margin = 0.01);
double distance(const Pose& a, const Pose& b);

}  // namespace indurop::robot
