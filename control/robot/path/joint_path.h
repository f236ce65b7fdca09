// SPDX-License-Identifier: Apache-2.0
// A path of the joints: straight pieces between points, with rounded corners. Places are seconds at full speed.

#pragma once

#include <array>

#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

class JointPath {
 public:
  static constexpr int kMostPoints = 32;

  // Begins at a point. Real-time safe, like all functions of this class.
  void begin(const Joints& from) noexcept;
  // Adds a straight piece to `to`; `velocity`: full speed of the joints. Returns false if there is no room, or if the
  // piece has no length: it is left out.
  bool add(const Joints& to, const Joints& velocity) noexcept;

  [[nodiscard]] int points() const noexcept { return count_; }
  // The place of a point on the path before it was rounded.
  [[nodiscard]] double place(int point) const noexcept { return places_[at_index(point)]; }
  [[nodiscard]] double length() const noexcept { return count_ > 0 ? place(count_ - 1) : 0; }
  [[nodiscard]] const Joints& end() const noexcept { return points_[at_index(count_ - 1)]; }
  // Rounds a corner, which is a point between two pieces, from `zone` before it to `zone` after it, s. Zones of two
  // corners must not overlap. The third derivative of the path is continuous.
  void round(int point, double zone) noexcept { zones_[at_index(point)] = zone; }
  [[nodiscard]] double zone(int point) const noexcept { return zones_[at_index(point)]; }

  // Joint values at a place, from 0 to length().
  [[nodiscard]] Joints at(double place) const noexcept;
  // How far the joints travel from one place to a later one, back and forth: never less than they do.
  [[nodiscard]] Joints travel(double from, double to) const noexcept;
  // The greatest speed of each joint along the path, per second at full speed.
  [[nodiscard]] Joints fastest() const noexcept;
  // The next place after this one at which the path stops being one simple curve; infinite if there is none.
  [[nodiscard]] double smooth_until(double place) const noexcept;

 private:
  static std::size_t at_index(int i) noexcept { return static_cast<std::size_t>(i); }
  // The piece that a place is on, from 0.
  [[nodiscard]] int piece_at(double place) const noexcept;

  int count_ = 0;
  std::array<double, kMostPoints> places_{}, zones_{};
  std::array<Joints, kMostPoints> points_{};
  std::array<Joints, kMostPoints> directions_{};  // of the piece after each point, per second at full speed
};

}  // namespace indurop::robot
