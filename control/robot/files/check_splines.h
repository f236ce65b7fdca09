// SPDX-License-Identifier: Apache-2.0
// Checks splines of jobs when the files are read.

#pragma once

#include <vector>

#include "control/robot/job/job.h"
#include "control/robot/kinematics/inverse.h"

namespace indurop::robot {

// Returns points that are out of reach, with the line of the spline. For arms without a closed form all points have
// been checked already.
std::vector<base::Diagnostic> check_splines(const JobBook& book, const Inverse& inverse);

}  // namespace indurop::robot
