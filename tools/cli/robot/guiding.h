// SPDX-License-Identifier: Apache-2.0
// Guides a robot by hand from a terminal, and writes a job of the path.

#pragma once

#include <cstdint>

#include "control/robot/files/teach.h"
#include "tools/cli/command/verb.h"
#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {

struct GuideOrder {
  robot::PathOrder path;    // without a name of a job: nothing is recorded
  std::int64_t for_ns = 0;  // 0: until Ctrl-C
};
// A hand may move the robot as long as this runs, in manual mode; it stops 0.3 s after that ends for whatever reason.
// Records the places of the axes meanwhile; Enter, or a new ROBOT_GUIDE.nMark, marks a point. Returns the exit code,
// after a message.
int guide(Context& context, const RobotChoice& choice, const GuideOrder& order);

}  // namespace indurop::tools
