// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/delta.h"

#include <Eigen/LU>
#include <cmath>

namespace indurop::robot {

namespace {

// Returns a vector in the plane of arm i.
Vec3 in_plane(int i, double out, double up) noexcept {
  const double direction = 2 * kPi / 3 * i;
  return {out * std::cos(direction), out * std::sin(direction), up};
}

}  // namespace

// Returns the ends of the upper arms, as if the platform were a point.
Mat3 Delta::knees(const Vec3& angles) const noexcept {
  Mat3 points;
  for (int i = 0; i < 3; ++i) {
    points.col(i) = in_plane(i, base - platform + upper * std::cos(angles[i]), -upper * std::sin(angles[i]));
  }
  return points;
}

// The point below all knees whose distance from each is the length of the rods.
Vec3 Delta::position(const Vec3& angles) const noexcept {
  const Mat3 points = knees(angles);
  const Vec3 a = points.col(1) - points.col(0);
  const Vec3 b = points.col(2) - points.col(0);
  const Vec3 normal = a.cross(b);  // points up
  const Vec3 middle =
      (b.squaredNorm() * normal.cross(a) + a.squaredNorm() * b.cross(normal)) / (2 * normal.squaredNorm());
  const double below = std::sqrt(lower * lower - middle.squaredNorm());
  return points.col(0) + middle - below * normal.normalized() - Vec3(0, 0, tool);
}

Mat3 Delta::moving(const Vec3& angles) const noexcept {
  const Vec3 platform_at = position(angles) + Vec3(0, 0, tool);
  const Mat3 points = knees(angles);
  Mat3 rods;
  Vec3 pushes;
  for (int i = 0; i < 3; ++i) {
    const Vec3 rod = platform_at - points.col(i);
    rods.row(i) = rod.transpose();
    pushes[i] = rod.dot(in_plane(i, -upper * std::sin(angles[i]), -upper * std::cos(angles[i])));
  }
  return rods.inverse() * pushes.asDiagonal();
}

}  // namespace indurop::robot
