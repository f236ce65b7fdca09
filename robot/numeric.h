// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of any arm, step by step with damped least squares.

#pragma once

#include "robot/postures.h"

namespace indurop::robot {

struct NumericSolution {
  Reach reach = Reach::OutOfReach;
  Joints q = Joints::Zero();
};

// From `near` on, within the limits; at most a hundred steps. Real-time safe; on a path a few steps are enough.
NumericSolution solve_numerically(const Arm& arm, const Pose& pose, const Joints& near) noexcept;

// How many places between the limits the search begins at: `least`, and up to `most` if nothing was found.
struct Starts {
  int least = 64;
  int most = 512;
};
// All the solutions that are found from there, told apart by `postures` if there are any. Takes milliseconds: for
// loading and planning.
Solutions search_numerically(const Arm& arm, const std::optional<Postures>& postures, const Pose& pose,
                             const Joints& near, const Starts& starts) noexcept;

}  // namespace indurop::robot
