// SPDX-License-Identifier: Apache-2.0
#include "robot/arm.h"

#include <cmath>

namespace indurop::robot {

Mat3 turned(const Vec3& axis, double angle) noexcept {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  const Vec3 t = (1 - c) * axis;
  Mat3 r;
  r << t.x() * axis.x() + c, t.x() * axis.y() - s * axis.z(), t.x() * axis.z() + s * axis.y(),
      t.x() * axis.y() + s * axis.z(), t.y() * axis.y() + c, t.y() * axis.z() - s * axis.x(),
      t.x() * axis.z() - s * axis.y(), t.y() * axis.z() + s * axis.x(), t.z() * axis.z() + c;
  return r;
}

Pose Arm::forward(const Joints& q) const noexcept {
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  for (int i = 0; i < kAxes; ++i) {
    const Axis& a = axis(i);
    const Mat3 turn = turned(a.direction, q[i]);
    shift += rotation * (a.point - turn * a.point);
    rotation = rotation * turn;
  }
  return {rotation * home_.position + shift, Quat(rotation) * home_.orientation};
}

Jacobian Arm::jacobian(const Joints& q) const noexcept {
  Jacobian j;
  std::array<Vec3, kAxes> points;
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  for (int i = 0; i < kAxes; ++i) {
    const Axis& a = axis(i);
    j.block<3, 1>(3, i) = rotation * a.direction;
    points[static_cast<std::size_t>(i)] = rotation * a.point + shift;
    const Mat3 turn = turned(a.direction, q[i]);
    shift += rotation * (a.point - turn * a.point);
    rotation = rotation * turn;
  }
  const Vec3 tool = rotation * home_.position + shift;
  for (int i = 0; i < kAxes; ++i) {
    const Vec3 direction = j.block<3, 1>(3, i);
    j.block<3, 1>(0, i) = direction.cross(tool - points[static_cast<std::size_t>(i)]);
  }
  return j;
}

int Arm::beyond_limits(const Joints& q, double slack) const noexcept {
  for (int i = 0; i < kAxes; ++i) {
    const Axis& a = axis(i);
    const bool inside = a.endless ? std::isfinite(q[i]) : q[i] >= a.lower - slack && q[i] <= a.upper + slack;
    if (!inside) {
      return i;
    }
  }
  return -1;
}

}  // namespace indurop::robot
