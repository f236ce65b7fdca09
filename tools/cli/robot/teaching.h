// SPDX-License-Identifier: Apache-2.0
// Points in a robot's files: lists them, and teaches them from the robot's current position.

#pragma once

#include "tools/cli/command/verb.h"
#include "tools/cli/robot/robot_desk.h"

namespace indurop::tools {

// Returns the exit code, as the next one does, after messages.
int show_points(Context& context, const RobotChoice& choice);
int teach_point(Context& context, const RobotChoice& choice, const robot::TeachOrder& order);

}  // namespace indurop::tools
