// SPDX-License-Identifier: Apache-2.0
// Points of a robot's files: shown, and taught from where the robot stands.

#pragma once

#include "tools/robot/robot_desk.h"

namespace indurop::tools {

// The exit code of both, after messages.
int show_points(Context& context, const RobotChoice& choice);
int teach_point(Context& context, const RobotChoice& choice, const robot::TeachOrder& order);

}  // namespace indurop::tools
