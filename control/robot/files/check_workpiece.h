// SPDX-License-Identifier: Apache-2.0
// Finds what cannot be used while axes move the workpiece, in whose frame all poses are.

#pragma once

#include <vector>

#include "control/robot/job/job.h"
#include "control/robot/kinematics/arm.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

// Returns an error for each TRACK, and one if there is a workspace. Nothing for arms whose workpiece stands still.
std::vector<base::Diagnostic> check_workpiece(const JobBook& book, const Arm& arm,
                                              const std::vector<double>& workspace);

}  // namespace indurop::robot
