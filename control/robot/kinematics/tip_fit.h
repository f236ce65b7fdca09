// SPDX-License-Identifier: Apache-2.0
// Computes the tip of a tool from the positions of the arm's end, three or more, in which the tip touched the same
// place: the centre of the spheres on which the end was. Knows nothing of jobs.

#pragma once

#include <span>
#include <string>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

struct TipFit {
  Vec3 tip = Vec3::Zero();  // m, seen from the arm's end
  double mean_error = 0;    // m, mean deviation of the positions from their common result
  double most_error = 0;
  std::size_t worst = 0;  // index of the position with most_error
  std::string wrong;      // why the positions give no result; empty if they do
};

// Not real-time safe.
TipFit fit_tip(std::span<const Pose> ends);

}  // namespace indurop::robot
