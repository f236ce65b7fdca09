// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/geometry.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

Joints joints_of(std::initializer_list<double> first) noexcept {
  Joints joints = Joints::Zero();
  std::copy_n(first.begin(), std::min(first.size(), static_cast<std::size_t>(kAxes)), joints.data());
  return joints;
}

Vec3 rotation_between(const Quat& from, const Quat& to) noexcept {
  Quat turn = from.conjugate() * to;
  if (turn.w() < 0) {
    turn.coeffs() = -turn.coeffs();
  }
  const double sine = turn.vec().norm();
  if (sine < 1e-12) {
    return 2 * turn.vec();
  }
  return turn.vec() * (2 * std::atan2(sine, turn.w()) / sine);
}

Quat rotation_by(const Vec3& vector) noexcept {
  const double angle = vector.norm();
  if (angle < 1e-12) {
    return Quat(1, vector.x() / 2, vector.y() / 2, vector.z() / 2).normalized();
  }
  const Vec3 part = vector * (std::sin(angle / 2) / angle);
  return {std::cos(angle / 2), part.x(), part.y(), part.z()};
}

Quat from_rpy(const Vec3& rpy) noexcept {
  using Eigen::AngleAxisd;
  return AngleAxisd(rpy.z(), Vec3::UnitZ()) * AngleAxisd(rpy.y(), Vec3::UnitY()) * AngleAxisd(rpy.x(), Vec3::UnitX());
}

Vec3 to_rpy(const Quat& orientation) noexcept {
  const Mat3 r = orientation.toRotationMatrix();
  const double level = std::hypot(r(0, 0), r(1, 0));
  const double pitch = std::atan2(-r(2, 0), level);
  if (level < 1e-9) {
    return {0, pitch, std::atan2(-r(0, 1), r(1, 1))};
  }
  return {std::atan2(r(2, 1), r(2, 2)), pitch, std::atan2(r(1, 0), r(0, 0))};
}

Twist difference(const Pose& from, const Pose& to) noexcept {
  Twist twist;
  twist.head<3>() = to.position - from.position;
  twist.tail<3>() = from.orientation * rotation_between(from.orientation, to.orientation);
  return twist;
}

}  // namespace indurop::robot
