// SPDX-License-Identifier: Apache-2.0
// What a robot holds, and the friction of its axes, from a recording of its motion.

#pragma once

#include <string>

#include "tools/cli/command/verb.h"
#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {

// Returns the exit code, after messages.
int identify_load(Context& context, const RobotChoice& choice, const std::string& recording);

}  // namespace indurop::tools
