// SPDX-License-Identifier: Apache-2.0
#include "control/io/axis_profile.h"

#include <algorithm>
#include <cmath>

namespace indurop::io {

bool AxisProfile::go_to(double target, double max_velocity, double acceleration, double dt) noexcept {
  const double left = target - position;
  const double step = acceleration * dt;
  if (std::fabs(left) <= step * dt && std::fabs(velocity) <= 2 * step) {
    position = target;
    velocity = 0;
    return true;
  }
  // The highest speed from which the axis can still stop at the target; the half step is the distance of one braking
  // step.
  const double allowed =
      std::min(max_velocity, std::sqrt(step * step / 4 + 2 * acceleration * std::fabs(left)) - step / 2);
  const double wanted = std::copysign(allowed, left);
  velocity += std::clamp(wanted - velocity, -step, step);
  position += velocity * dt;
  return false;
}

bool AxisProfile::change_velocity(double target, double acceleration, double dt) noexcept {
  const double step = acceleration * dt;
  velocity += std::clamp(target - velocity, -step, step);
  position += velocity * dt;
  return velocity == target;
}

}  // namespace indurop::io
