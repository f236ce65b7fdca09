// SPDX-License-Identifier: Apache-2.0
// The box that the tool's point must not leave, in the base's frame. From outside it may return, but not move farther
// out.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

class Workspace {
 public:
  // Unlimited workspace.
  Workspace() = default;
  // A box given by two opposite corners, m.
  Workspace(const Vec3& corner, const Vec3& other) noexcept
      : known_(true), low_(corner.cwiseMin(other)), high_(corner.cwiseMax(other)) {}
  // A box from a setting: six numbers in mm, or none for an unlimited workspace.
  static Workspace of(const std::vector<double>& corners) noexcept;

  [[nodiscard]] bool known() const noexcept { return known_; }
  // Distance outside in m; below 0 the distance inside.
  [[nodiscard]] double outside(const Vec3& point) const noexcept {
    return known_ ? std::max((low_ - point).maxCoeff(), (point - high_).maxCoeff()) : -HUGE_VAL;
  }
  // Returns whether a motion from `from` to `to` leaves the box, or leads farther out. `bulge`: m by which the path may
  // deviate from a straight line.
  [[nodiscard]] bool left(const Vec3& from, const Vec3& to, double bulge = 0) const noexcept;
  // "x -800 to 800, y ..., mm"
  [[nodiscard]] std::string text() const;

 private:
  bool known_ = false;
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
};

// A path through the box that is checked place by place.
class WayInside {
 public:
  WayInside(const Workspace& box, const Vec3& start) noexcept : box_(box), seen_{start, start} {}
  // Returns whether the path up to the next place stays inside.
  bool next(const Vec3& place) noexcept;

 private:
  Workspace box_;
  bool begun_ = false;
  std::array<Vec3, 2> seen_;  // the latest first
};

}  // namespace indurop::robot
