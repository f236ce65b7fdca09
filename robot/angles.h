// SPDX-License-Identifier: Apache-2.0
// Small questions about angles that closed forms of the inverse kinematics ask. Real-time safe.

#pragma once

#include <Eigen/Core>
#include <optional>

#include "robot/arm.h"

namespace indurop::robot {

// What closed forms take for the same.
struct Close {
  static constexpr double kParallel = 1e-6;  // sine or cosine of angles that count as none
  static constexpr double kTouching = 1e-6;  // m, between lines that count as meeting
  static constexpr double kSingular = 1e-7;  // below, an angle says nothing any more
};

double angle_of(const Eigen::Vector2d& v) noexcept;
Eigen::Vector2d turned2(const Eigen::Vector2d& v, double angle) noexcept;
// The angle about `axis` from the direction of `from` to that of `to`.
double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) noexcept;
// acos of a cosine that rounding may have put slightly beyond 1; nothing if it is far beyond.
std::optional<double> angle_with_cosine(double cosine) noexcept;
// `angle` plus as many turns as bring it nearest to `near` within the axis' limits; nothing if none is within. What
// slides does not turn.
std::optional<double> turn_nearest(const Axis& axis, double angle, double near) noexcept;
// The point of axis `a` that is nearest to axis `b`; they are not parallel.
Vec3 nearest_point(const Axis& a, const Axis& b) noexcept;
// m between the axis and the point
double distance(const Axis& axis, const Vec3& point) noexcept;

// In the plane, two sides of a triangle that are turned at its origin and between them: how to reach a point.
struct Compass {
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();
  struct Angles {
    double first = 0;
    double second = 0;
  };
  // How far the second one is turned where both are stretched.
  [[nodiscard]] double straight() const noexcept { return angle_of(upper) - angle_of(lower); }
  // Nothing if it is too near or too far. `other`: bent to the other side.
  [[nodiscard]] std::optional<Angles> reach(const Eigen::Vector2d& point, bool other) const noexcept;
};

}  // namespace indurop::robot
