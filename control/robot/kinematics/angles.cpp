// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/angles.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

double angle_of(const Eigen::Vector2d& v) noexcept {
  return std::atan2(v.y(), v.x());
}

Eigen::Vector2d turned2(const Eigen::Vector2d& v, double angle) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

// Uses only the components perpendicular to the axis: for vectors nearly along it, differences of products would lose
// all precision.
double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) noexcept {
  const Vec3 f = from - axis * axis.dot(from);
  const Vec3 t = to - axis * axis.dot(to);
  return std::atan2(axis.dot(f.cross(t)), f.dot(t));
}

std::optional<double> angle_with_cosine(double cosine) noexcept {
  constexpr double kStretch = 1e-9;  // a target just out of reach by rounding counts as at the limit of reach
  if (!(std::abs(cosine) <= 1 + kStretch)) {
    return std::nullopt;
  }
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

std::optional<double> turn_nearest(const Axis& axis, double angle, double near) noexcept {
  constexpr double kSlack = 1e-9;
  if (axis.slides()) {
    const bool within = angle >= axis.lower - kSlack && angle <= axis.upper + kSlack;
    return within ? std::optional(std::clamp(angle, axis.lower, axis.upper)) : std::nullopt;
  }
  const double turn = 2 * kPi;
  double best = angle + turn * std::round((near - angle) / turn);
  if (axis.endless) {
    return best;
  }
  if (best > axis.upper + kSlack) {
    best -= turn * std::ceil((best - axis.upper - kSlack) / turn);
  } else if (best < axis.lower - kSlack) {
    best += turn * std::ceil((axis.lower - kSlack - best) / turn);
  }
  if (best > axis.upper + kSlack || best < axis.lower - kSlack) {
    return std::nullopt;
  }
  return std::clamp(best, axis.lower, axis.upper);
}

Vec3 nearest_point(const Axis& a, const Axis& b) noexcept {
  const Vec3 normal = a.direction.cross(b.direction);
  const Vec3 between = b.point - a.point;
  return a.point + a.direction * (between.cross(b.direction).dot(normal) / normal.squaredNorm());
}

double distance(const Axis& axis, const Vec3& point) noexcept {
  return axis.direction.cross(point - axis.point).norm();
}

std::optional<Compass::Angles> Compass::reach(const Eigen::Vector2d& point, bool other) const noexcept {
  const double a = upper.norm();
  const double b = lower.norm();
  const auto bend = angle_with_cosine((point.squaredNorm() - a * a - b * b) / (2 * a * b));
  if (!bend) {
    return std::nullopt;
  }
  const double second = straight() + (other ? -*bend : *bend);
  return Angles{angle_of(point) - angle_of(upper + turned2(lower, second)), second};
}

}  // namespace indurop::robot
