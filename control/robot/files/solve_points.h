// SPDX-License-Identifier: Apache-2.0
// Which points of the job files the arm reaches, with what they say of its axes.

#pragma once

#include <vector>

#include "control/robot/job/job.h"
#include "control/robot/kinematics/arm.h"
#include "core/base/diagnostic.h"

namespace indurop::robot {

// Returns whether the place of a point is known while the files are read. `placed`: tools and frames have been found.
bool is_known(const Point& point, const JobBook& book, bool placed);
// Returns errors for points of joint values that are beyond the limits of the arm.
std::vector<base::Diagnostic> check_points(const JobBook& book, const Arm& arm);
// Finds how the arm may hold its tools at points that are poses, and notes this in the book where it takes long.
// Returns errors and warnings for those that are not reached.
std::vector<base::Diagnostic> solve_points(JobBook& book, const Arm& arm, bool placed);
// Returns errors for AXIS in lines of motions.
std::vector<base::Diagnostic> check_axes_of_motions(const JobBook& book, const Arm& arm);

}  // namespace indurop::robot
