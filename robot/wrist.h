// SPDX-License-Identifier: Apache-2.0
// Three turns about axes one behind the other that make a rotation, as those of a wrist do: two ways.

#pragma once

#include <optional>

#include "robot/geometry.h"

namespace indurop::robot {

class Wrist {
 public:
  struct Angles {
    double first = 0;
    double middle = 0;
    double last = 0;
  };
  // Where only the sum of the first and the last counts, this one stays as it is.
  struct Keep {
    bool first = true;
    double angle = 0;
  };

  Wrist() = default;
  // Directions at angles zero; neighbours are not parallel. Real-time safe, as all here.
  Wrist(const Vec3& first, const Vec3& middle, const Vec3& last) noexcept;

  // What the middle one says: which of the two ways an angle belongs to is the sign of its sine behind this one.
  [[nodiscard]] double straight() const noexcept;
  // Nothing if no turns make it. `other`: the other way.
  [[nodiscard]] std::optional<Angles> turn(const Mat3& rotation, bool other, const Keep& keep) const noexcept;

 private:
  [[nodiscard]] std::optional<double> bent_by(const Vec3& wanted) const noexcept;

  Vec3 first_ = Vec3::UnitZ(), middle_ = Vec3::UnitY(), last_ = Vec3::UnitZ();
  double cosine_ = 0, sine_ = 0, constant_ = 0;  // first * (last turned by the middle angle) = these * cos, sin, 1
};

}  // namespace indurop::robot
