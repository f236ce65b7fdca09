// SPDX-License-Identifier: Apache-2.0
// Where the tip of a tool is, from the arm's end in three or more positions in which the tip touched the same place:
// the centre of the spheres on which the end was. Knows nothing of jobs.

#pragma once

#include <span>
#include <string>

#include "robot/geometry.h"

namespace indurop::robot {

struct TipFit {
  Vec3 tip = Vec3::Zero();  // m, seen from the arm's end
  double mean_error = 0;    // m, from what the positions say on average to what each of them says
  double most_error = 0;
  std::size_t worst = 0;  // the position with most_error
  std::string wrong;      // why the positions say nothing; empty if they do
};

// Not real-time safe.
TipFit fit_tip(std::span<const Pose> ends);

}  // namespace indurop::robot
