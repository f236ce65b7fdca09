// SPDX-License-Identifier: Apache-2.0
// Three rotations about successive axes that yield a given rotation, as in a wrist: there are two solutions.

#pragma once

#include <optional>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

class Wrist {
 public:
  struct Angles {
    double first = 0;
    double middle = 0;
    double last = 0;
  };
  // If only the sum of the first and the last angle matters, this one is kept.
  struct Keep {
    bool first = true;
    double angle = 0;
  };

  Wrist() = default;
  // Directions of the axes at angles zero; neighbours are not parallel. Real-time safe, like all functions of this
  // class.
  Wrist(const Vec3& first, const Vec3& middle, const Vec3& last) noexcept;

  // The middle angle at which the wrist is straight: the sign of the sine of the middle angle minus this one tells
  // which of the two solutions it belongs to.
  [[nodiscard]] double straight() const noexcept;
  // Returns nothing if no angles yield the rotation. `other`: the other solution.
  [[nodiscard]] std::optional<Angles> turn(const Mat3& rotation, bool other, const Keep& keep) const noexcept;

 private:
  [[nodiscard]] std::optional<double> bent_by(const Vec3& wanted) const noexcept;

  Vec3 first_ = Vec3::UnitZ(), middle_ = Vec3::UnitY(), last_ = Vec3::UnitZ();
  double cosine_ = 0, sine_ = 0, constant_ = 0;  // first * (last turned by the middle angle) = these * cos, sin, 1
};

}  // namespace indurop::robot
