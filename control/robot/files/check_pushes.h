// SPDX-License-Identifier: Apache-2.0
// Finds PUSH statements with more torque than their axis has.

#pragma once

#include <vector>

#include "control/robot/files/urdf.h"
#include "control/robot/job/job.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

// Returns an error for each of them. `rated`: as Settings::rated_torque. Without it, or without masses in the URDF, no
// axis can push at all, and nothing is found.
std::vector<base::Diagnostic> check_pushes(const JobBook& book, const ArmModel& model,
                                           const std::vector<double>& rated);

}  // namespace indurop::robot
