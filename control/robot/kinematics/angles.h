// SPDX-License-Identifier: Apache-2.0
// Angle computations for the closed forms of the inverse kinematics. Real-time safe.

#pragma once

#include <Eigen/Core>
#include <optional>

#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

// Tolerances of the closed forms.
struct Close {
  static constexpr double kParallel = 1e-6;  // sine or cosine of angles that count as zero
  static constexpr double kTouching = 1e-6;  // m, between lines that count as intersecting
  static constexpr double kSingular = 1e-7;  // an angle is undefined below this
};

double angle_of(const Eigen::Vector2d& v) noexcept;
Eigen::Vector2d turned2(const Eigen::Vector2d& v, double angle) noexcept;
// Returns the angle about `axis` from the direction of `from` to that of `to`.
double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) noexcept;
// Returns acos of a cosine that rounding may have put slightly beyond 1; nothing if it is far beyond.
std::optional<double> angle_with_cosine(double cosine) noexcept;
// Returns `angle` plus the number of full turns that brings it nearest to `near` within the axis' limits; nothing if
// none is within. No turns are added for sliding axes.
std::optional<double> turn_nearest(const Axis& axis, double angle, double near) noexcept;
// Returns the point of axis `a` that is nearest to axis `b`. The axes must not be parallel.
Vec3 nearest_point(const Axis& a, const Axis& b) noexcept;
// Returns the distance between the axis and the point, in m.
double distance(const Axis& axis, const Vec3& point) noexcept;

// A planar arm of two segments that turn at the origin and at the joint between them: solves how to reach a point.
struct Compass {
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();
  struct Angles {
    double first = 0;
    double second = 0;
  };
  // Returns the angle of the second segment at which the arm is stretched.
  [[nodiscard]] double straight() const noexcept { return angle_of(upper) - angle_of(lower); }
  // Returns nothing if the point is too near or too far. `other`: bent to the other side.
  [[nodiscard]] std::optional<Angles> reach(const Eigen::Vector2d& point, bool other) const noexcept;
};

}  // namespace indurop::robot
