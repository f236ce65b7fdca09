// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/postures.h"

#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kNearly = 0.05;  // rad

bool nearly_parallel(const Axis& a, const Axis& b) noexcept {
  return a.direction.cross(b.direction).norm() < kNearly;
}

}  // namespace

std::optional<Postures> Postures::of(const Arm& arm) {
  if (!arm.turns_six()) {
    return std::nullopt;
  }
  const Axis& a1 = arm.axis(0);
  const Axis& a2 = arm.axis(1);
  const Axis& a3 = arm.axis(2);
  const Axis& a4 = arm.axis(3);
  const Axis& a5 = arm.axis(4);
  const Axis& a6 = arm.axis(5);
  if (!nearly_parallel(a2, a3) || nearly_parallel(a1, a2) || nearly_parallel(a4, a5) || nearly_parallel(a5, a6)) {
    return std::nullopt;
  }
  Postures postures;
  const bool parallel = nearly_parallel(a2, a4);
  postures.before_wrist_ = parallel ? 4 : 3;
  postures.center_ = parallel ? nearest_point(a5, a6) : nearest_point(a4, a5);
  postures.across_ = a1.direction.cross(a2.direction);
  postures.front_ = postures.across_.dot(postures.center_ - a1.point) >= 0 ? 1 : -1;
  const Vec3 x = a2.direction.unitOrthogonal();
  const Vec3 y = a2.direction.cross(x);
  const auto in_plane = [&](const Vec3& v) { return Eigen::Vector2d(x.dot(v), y.dot(v)); };
  const Compass compass{in_plane(a3.point - a2.point), in_plane((parallel ? a4.point : postures.center_) - a3.point)};
  postures.straight_ = compass.straight();
  postures.third_sign_ = a2.direction.dot(a3.direction) > 0 ? 1 : -1;
  postures.wrist_ = Wrist(parallel ? a2.direction : a4.direction, a5.direction, a6.direction).straight();
  return postures;
}

std::uint8_t Postures::at(const Arm& arm, const Joints& q) const noexcept {
  Vec3 center = center_;
  for (int i = before_wrist_ - 1; i > 0; --i) {
    const Axis& a = arm.axis(i);
    center = turned(a.direction, q[i]) * (center - a.point) + a.point;
  }
  unsigned posture = 0;
  posture |= across_.dot(center - arm.axis(0).point) * front_ < 0 ? Solution::kShoulder : 0U;
  posture |= std::sin(third_sign_ * q[2] - straight_) < 0 ? Solution::kElbow : 0U;
  posture |= std::sin(q[4] - wrist_) < 0 ? Solution::kWrist : 0U;
  return static_cast<std::uint8_t>(posture);
}

}  // namespace indurop::robot
