// SPDX-License-Identifier: Apache-2.0
// Where the tip of the gripper really is: from the axes of robot.urdf, independent of what the robot task computes.
#pragma once

#include <array>

struct Tip {
  double x = 0, y = 0, z = 0;                   // mm, base frame
  double angle = 0;                             // deg, of the tool's x axis about the vertical
  double tilt = 0;                              // deg, between the tool's z axis and straight down
  std::array<std::array<double, 3>, 3> axes{};  // of the tool: its x, y and z
};

Tip arm_tip(const std::array<double, 6>& degrees);
