// SPDX-License-Identifier: Apache-2.0
// What of the splines of jobs cannot work is said when the files are read.

#pragma once

#include <vector>

#include "robot/inverse.h"
#include "robot/job.h"

namespace indurop::robot {

// Points that are out of reach, with the line of the spline. Of arms without a closed form all points have been
// searched for already.
std::vector<base::Diagnostic> check_splines(const JobBook& book, const Inverse& inverse);

}  // namespace indurop::robot
