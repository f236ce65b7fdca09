// SPDX-License-Identifier: Apache-2.0
// Computes where a frame is from places that are known both in the frame and in the base: a camera that was shown what
// the arm touched. Knows nothing of jobs.

#pragma once

#include <span>
#include <string>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

// A place in the frame, and the same place in the base.
struct MatchedPlace {
  Vec3 in_frame = Vec3::Zero();
  Vec3 in_base = Vec3::Zero();
};

struct FrameFit {
  Pose frame;
  double mean_error = 0;  // m, mean deviation of the places
  double most_error = 0;
  std::size_t worst = 0;  // index of the place with most_error
  std::string wrong;      // why they give no result; empty if they do
};

// The rigid motion with the least sum of squared deviations (Kabsch 1976, Umeyama 1991). Not real-time safe.
FrameFit fit_frame(std::span<const MatchedPlace> places);

}  // namespace indurop::robot
