// SPDX-License-Identifier: Apache-2.0
// Where a robot is, for tools that write that into its files.

#pragma once

#include <array>
#include <vector>

namespace indurop::robot {

// The present position of the robot.
struct Stand {
  std::vector<double> joints;           // deg, of sliding axes mm; at least as many as the arm has
  std::array<double, 3> position{};     // mm, of the tip in the base
  std::array<double, 3> orientation{};  // deg, roll pitch yaw
};

}  // namespace indurop::robot
