// SPDX-License-Identifier: Apache-2.0
// The box that the tool's point does not leave, in the base's frame. Whoever is outside may come back, but not get
// farther out.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "robot/geometry.h"

namespace indurop::robot {

class Workspace {
 public:
  // Everywhere.
  Workspace() = default;
  // Two opposite corners, m.
  Workspace(const Vec3& corner, const Vec3& other) noexcept
      : known_(true), low_(corner.cwiseMin(other)), high_(corner.cwiseMax(other)) {}
  // Of a setting: six numbers in mm, or none for everywhere.
  static Workspace of(const std::vector<double>& corners) noexcept;

  [[nodiscard]] bool known() const noexcept { return known_; }
  // m; how far outside, below 0 how far inside.
  [[nodiscard]] double outside(const Vec3& point) const noexcept {
    return known_ ? std::max((low_ - point).maxCoeff(), (point - high_).maxCoeff()) : -HUGE_VAL;
  }
  // Whether going from one to the other leaves it, or leads farther out. `bulge`: m that the way between may be off a
  // straight line.
  [[nodiscard]] bool left(const Vec3& from, const Vec3& to, double bulge = 0) const noexcept;
  // "x -800 to 800, y ..., mm"
  [[nodiscard]] std::string text() const;

 private:
  bool known_ = false;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
};

// A way through the box that is seen place by place.
class WayInside {
 public:
  WayInside(const Workspace& box, const Vec3& start) noexcept : box_(box), seen_{start, start} {}
  // Whether the way up to the next place stays inside.
  bool next(const Vec3& place) noexcept;

 private:
  Workspace box_;
  bool begun_ = false;
  std::array<Vec3, 2> seen_;  // the latest first
};

}  // namespace indurop::robot
