// SPDX-License-Identifier: Apache-2.0
// Finds lines and circles that are slower than the SPEED in mm/s says, because an axis that turns the workpiece, an
// elbow or a rail has to move too far meanwhile (AXIS).

#pragma once

#include <vector>

#include "control/robot/files/urdf.h"
#include "control/robot/job/job.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

// Returns a warning for each of them, as far as it is known before the job runs where they begin. `tool_speed`: mm/s,
// full speed of the tool.
std::vector<base::Diagnostic> check_slow_axes(const JobBook& book, const ArmModel& model, double tool_speed);

}  // namespace indurop::robot
