// SPDX-License-Identifier: Apache-2.0
// A delta: three upper arms turn about the sides of a triangle and carry a platform that stays parallel to the base, by
// pairs of rods. The base's z axis points up; the arms are at 0, 120 and 240 degrees about it; positive angles go down.

#pragma once

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

struct Delta {
  double base = 0;      // m, from the centre to the axes
  double upper = 0;     // length of the arms
  double lower = 0;     // length of the rods
  double platform = 0;  // from the centre to the rods
  double tool = 0;      // the tool's point below the platform

  // Returns the position of the tool's point; NaN where the rods do not meet. All functions of this class are real-time
  // safe.
  [[nodiscard]] Vec3 position(const Vec3& angles) const noexcept;
  // Returns the derivative of the position by the angles.
  [[nodiscard]] Mat3 moving(const Vec3& angles) const noexcept;

 private:
  [[nodiscard]] Mat3 knees(const Vec3& angles) const noexcept;
};

}  // namespace indurop::robot
