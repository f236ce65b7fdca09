// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/arc.h"

#include <cmath>

namespace indurop::robot {

bool Arc::through(const Vec3& start, const Vec3& mid, const Vec3& end) noexcept {
  const Vec3 a = mid - start;
  const Vec3 b = end - start;
  const Vec3 normal = a.cross(b);
  const double area = normal.squaredNorm();
  if (area < 1e-6 * a.squaredNorm() * b.squaredNorm() || area <= 0) {
    return false;
  }
  center = start + (a.squaredNorm() * b.cross(normal) - b.squaredNorm() * a.cross(normal)) / (2 * area);
  radius_x = start - center;
  // The normal is such that the path from start through mid to end turns left about it.
  radius_y = normal.normalized().cross(radius_x);
  const Vec3 last = end - center;
  angle = std::atan2(radius_y.dot(last), radius_x.dot(last));
  if (angle <= 0) {
    angle += 2 * kPi;
  }
  return true;
}

Vec3 Arc::derivative(double part, int order) const noexcept {
  // Each derivative is a quarter of a turn ahead.
  const double at = part * angle + order * kPi / 2;
  return std::pow(angle, order) * (std::cos(at) * radius_x + std::sin(at) * radius_y);
}

}  // namespace indurop::robot
