// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of any arm, step by step. With six axes the tool comes to the pose; with more, some are held where
// they are, so that a path always comes to the same joints; with fewer, it comes to the position, and turns as near to
// the orientation as the arm can there.

#pragma once

#include "robot/postures.h"

namespace indurop::robot {

// Axes that are held, a bit each.
using Held = unsigned;
// Of an arm with more than six axes: those that slide, else the third, whose angle says where the elbow is.
Held redundant_axes(const Arm& arm) noexcept;

struct NumericSolution {
  Reach reach = Reach::OutOfReach;
  Joints q = Joints::Zero();
};

// From `near` on, within the limits; at most a hundred steps. Real-time safe; on a path a few steps are enough.
NumericSolution solve_numerically(const Arm& arm, const Pose& pose, const Joints& near) noexcept;

struct Search {
  // Places between the limits where it begins: `least`, and up to `most` if nothing was found.
  int least = 64;
  int most = 512;
  // rad by which arms of fewer than six axes may miss the orientation: what is written down is rounded.
  double turned = 2e-3;
  // Axes that stand where those of `near` do; redundant ones may be anywhere otherwise.
  Held held = 0;
};
// All the solutions that are found from there, told apart by `postures` if there are any. Takes milliseconds: for
// loading and planning.
Solutions search_numerically(const Arm& arm, const std::optional<Postures>& postures, const Pose& pose,
                             const Joints& near, const Search& how) noexcept;

}  // namespace indurop::robot
