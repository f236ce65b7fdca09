// SPDX-License-Identifier: Apache-2.0
// A pose as commands write it: x y z in mm, roll pitch yaw in degrees.

#pragma once

#include <array>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

inline Pose pose_of(const std::array<double, 8>& numbers) noexcept {
  const Eigen::Map<const Eigen::Matrix<double, 6, 1>, Eigen::Unaligned> six(numbers.data());
  return {six.head<3>() / 1000, from_rpy({radians(six[3]), radians(six[4]), radians(six[5])})};
}

}  // namespace indurop::robot
