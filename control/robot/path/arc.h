// SPDX-License-Identifier: Apache-2.0
// An arc of a circle in space.

#pragma once

#include <cmath>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

struct Arc {
  Vec3 center = Vec3::Zero(), radius_x = Vec3::Zero(), radius_y = Vec3::Zero();
  double angle = 0;  // from radius_x on, turning to radius_y

  // Makes the arc from `start` through `mid` to `end`. Returns false if they are on one line. Real-time safe, like all
  // functions of this struct.
  bool through(const Vec3& start, const Vec3& mid, const Vec3& end) noexcept;
  // The point at this part of it, from 0 to 1.
  [[nodiscard]] Vec3 at(double part) const noexcept {
    return center + std::cos(part * angle) * radius_x + std::sin(part * angle) * radius_y;
  }
  // Derivative of the point by the part, of order 1, 2 or 3.
  [[nodiscard]] Vec3 derivative(double part, int order) const noexcept;
  // m
  [[nodiscard]] double way() const noexcept { return angle * radius_x.norm(); }
};

}  // namespace indurop::robot
