// SPDX-License-Identifier: Apache-2.0
// Calibrates tools, frames and cameras of a robot from its current positions, or from a file of points.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "control/robot/files/calibrate.h"
#include "tools/cli/command/verb.h"
#include "tools/client/robot/robot_desk.h"

namespace indurop::tools {

// What to do with the calibration before it is shown; at most one of them.
struct CalibrationAct {
  bool take = false;
  bool drop_all = false;
  bool accept = false;
  std::optional<int> drop;  // from 1
  robot::TakenPoint taken;  // tool: filled in
};

// Returns the exit code, after messages.
int calibrate(Context& context, const RobotChoice& choice, const robot::CalibrationOrder& order, CalibrationAct act);

}  // namespace indurop::tools
