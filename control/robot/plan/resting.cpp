// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/resting.h"

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/bisect.h"

namespace indurop::robot {

namespace {

// Distance of the fastest stop from a constant speed.
double stop_from(double velocity, const LineLimits& limits) noexcept {
  const double ramp = limits.acceleration * limits.acceleration / limits.jerk;  // speed that two ramps take away
  return velocity < ramp ? velocity * std::sqrt(velocity / limits.jerk)
                         : velocity * (velocity / limits.acceleration + limits.acceleration / limits.jerk) / 2;
}

}  // namespace

double farthest_at_stop(double velocity, double acceleration, const LineLimits& limits) noexcept {
  const double jerk = limits.jerk;
  const double unload = acceleration / jerk;  // s, signed
  const double change = acceleration * unload / 2;
  if (acceleration >= 0) {
    const double fastest = velocity + change;
    return fastest <= 0
               ? 0
               : std::max(0.0, velocity * unload + unload * unload * acceleration / 3 + stop_from(fastest, limits));
  }
  if (velocity <= 0) {
    return 0;
  }
  if (velocity <= change) {
    // It turns before the deceleration is zero, even if that is reduced from now on.
    const double time = (-acceleration - std::sqrt(acceleration * acceleration - 2 * jerk * velocity)) / jerk;
    return time * (velocity + time * (acceleration / 2 + time * jerk / 6));
  }
  // The rest of a stop that has begun from a constant speed.
  const double before = velocity + change;
  return std::max(0.0, stop_from(before, limits) + unload * (before - unload * unload * jerk / 6));
}

double slower_for_rest(double room, double velocity, double acceleration, const LineLimits& limits,
                       double most) noexcept {
  const auto rests = [&](double slower) {
    return farthest_at_stop(velocity / slower, acceleration / (slower * slower), limits) <= room;
  };
  if (rests(1)) {
    return 1;
  }
  if (!rests(most)) {
    return most;
  }
  constexpr double kNear = 0.001;
  return bisect({most, 1}, 40, rests, [](const Bisected& now) { return now.holds - now.fails > kNear; }).holds;
}

}  // namespace indurop::robot
