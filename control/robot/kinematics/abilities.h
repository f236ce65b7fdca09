// SPDX-License-Identifier: Apache-2.0
// Describes in words which requests an arm can fulfil. Not real-time safe.

#pragma once

#include <string>

#include "control/robot/kinematics/inverse.h"

namespace indurop::robot {

// Returns a text such as "4 axes; poses: x y z and turns about the base's (0 0 1); inverse kinematics step by step; no
// postures".
std::string abilities(const Arm& arm, const Inverse& inverse);

}  // namespace indurop::robot
