// SPDX-License-Identifier: Apache-2.0
// Makes a robot read its jobs again.

#pragma once

#include "tools/cli/command/verb.h"
#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {

// Returns the exit code.
int reload_jobs(Context& context, const RobotChoice& choice);

}  // namespace indurop::tools
