// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of any arm by iteration. With six axes the tool reaches the pose. With more, some axes are held at
// their values, so that a path always leads to the same joint angles. With fewer, the tool reaches the position, and
// its orientation is as close as the arm can get there.

#pragma once

#include "control/robot/kinematics/held_axes.h"
#include "control/robot/kinematics/postures.h"

namespace indurop::robot {

// Turning axes stay this far from their limits where the elbow can move, rad.
inline constexpr double kElbowRoom = 0.1;
// rad by which the turning axis of the arm that is nearest to a limit is away from it; negative beyond the limit.
double room_of(const Arm& arm, const Joints& q) noexcept;

struct NumericSolution {
  Reach reach = Reach::OutOfReach;
  Joints q = Joints::Zero();
};

// Iterates from `near`, within the limits; at most a hundred steps. Real-time safe; on a path a few steps are enough.
NumericSolution solve_numerically(const Arm& arm, const Pose& pose, const Joints& near) noexcept;
// The same for a single pose, not for a path: if the held axes are in the way, or an axis gets too close to a limit,
// the turning ones among them move, away from limits as far as kElbowRoom. Real-time safe.
NumericSolution solve_freely(const Arm& arm, const Pose& pose, const Joints& near) noexcept;

struct Search {
  // Number of start values between the limits: `least`, and up to `most` if nothing was found.
  int least = 64;
  int most = 512;
  // rad by which arms with fewer than six axes may miss the orientation, because written values are rounded.
  double turned = 2e-3;
  // Axes that stay at their values in `near`; other redundant axes may have any value.
  Held held = 0;
};
// All solutions that are found from these start values, distinguished by `postures` if given. Takes milliseconds: for
// loading and planning.
Solutions search_numerically(const Arm& arm, const std::optional<Postures>& postures, const Pose& pose,
                             const Joints& near, const Search& how) noexcept;

}  // namespace indurop::robot
