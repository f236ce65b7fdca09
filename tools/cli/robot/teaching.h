// SPDX-License-Identifier: Apache-2.0
// Points in a robot's files: lists them, and teaches them from the robot's current position.

#pragma once

#include "control/robot/files/teach.h"
#include "tools/cli/command/verb.h"
#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {

// Returns the exit code, as the next one does, after messages.
int show_points(Context& context, const RobotChoice& choice);
int teach_point(Context& context, const RobotChoice& choice, const robot::TeachOrder& order);

// Reads the current place of the robot, if it is at standstill.
int place_to_write(Context& context, const RobotChoice& choice, RobotPlace& to);

}  // namespace indurop::tools
