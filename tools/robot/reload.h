// SPDX-License-Identifier: Apache-2.0
// Has a robot read its jobs anew.

#pragma once

#include "tools/robot/robot_desk.h"

namespace indurop::tools {

// The exit code.
int reload_jobs(Context& context, const RobotChoice& choice);

}  // namespace indurop::tools
