// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/wave.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

// The polynomial of the fifth degree whose first and second derivatives are 0 at both ends. Next to it the wave is
// nearly linear, so that speed, acceleration and jerk begin at 0, too.
double Wave::swell(double gone, double whole, double length) noexcept {
  const double ramp = std::min(length, whole / 2);
  const double x = ramp > 0 ? std::clamp(std::min(gone, whole - gone) / ramp, 0.0, 1.0) : 0;
  return x * x * x * (10 + x * (6 * x - 15));
}

double Wave::at(double gone, double whole) const noexcept {
  const double phase = 2 * kPi * gone / length;
  const double shape = (std::sin(phase) + third * std::sin(3 * phase)) / (1 - third);
  return width / 2 * swell(gone, whole, length) * shape;
}

Wave::Steepness Wave::steepness() const noexcept {
  const double often = 2 * kPi / length;
  const double half = width / 2 / (1 - third);
  const double more = std::abs(third);
  return {half * often * (1 + 3 * more), half * often * often * (1 + 9 * more),
          half * often * often * often * (1 + 27 * more)};
}

Vec3 Wave::side(const Vec3& moving, const Quat& tool) const noexcept {
  constexpr double kLeast = 0.1736;  // sine of 10 degrees
  const Vec3 forward = moving.normalized();
  const Vec3 across = forward.cross(tool * Vec3::UnitZ());
  const double size = across.norm();
  if (!(size >= kLeast)) {
    return Vec3::Zero();
  }
  const Vec3 left = across / size;
  return std::cos(turned) * left + std::sin(turned) * forward.cross(left);
}

Pose Wave::shifted(Pose pose, const PathWay& way) const noexcept {
  pose.position += at(way.gone, way.whole) * side(way.moving, pose.orientation);
  return pose;
}

}  // namespace indurop::robot
