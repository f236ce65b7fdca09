// SPDX-License-Identifier: Apache-2.0
// The job of a robot: what it does now, which jobs it has interrupted for that, and which interrupts wait.

#pragma once

#include "tools/cli/command/verb.h"
#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {

// Returns the exit code, after messages.
int show_job(Context& context, const RobotChoice& choice);

}  // namespace indurop::tools
