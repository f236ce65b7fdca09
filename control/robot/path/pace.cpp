// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/pace.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr int kStages = 8;
constexpr double kPaceRounding = 1e-9;

bool can_level_off(const LineState& now, double top, const PaceLimits& limits) noexcept {
  const LineLimits there = limits.at(top);
  return unloaded(now, there) <= top + kPaceRounding && now.acceleration <= there.acceleration * (1 + kPaceRounding);
}

}  // namespace

LineLimits PaceLimits::at(double pace) const noexcept {
  // Half of the jerk that is left is for the change of pace itself, half for its effect on accelerations.
  const double left = (1 - jerk_share * pace * pace * pace) / 2;
  return {1, std::min((1 - acceleration_share * pace * pace) * acceleration, left * mixed / (3 * std::max(pace, 1e-3))),
          left * jerk};
}

// When the pace rises, less and less is left for changes, so it must be able to level off at some pace with what is
// left there. Of the intermediate paces that allow this, the highest one is chosen.
Profile PaceChange::faster(const LineState& now, double wanted, double seconds, const PaceLimits& limits) noexcept {
  Profile best;
  double most = -1;
  const auto consider = [&](double top) {
    const Profile stage = Profile::to_velocity(now, top, limits.at(top));
    if (const double there = stage.at(seconds).velocity; there > most) {
      best = stage;
      most = there;
      top_ = top;
    }
  };
  if (now.acceleration > 0) {
    consider(top_);
  }
  for (int i = 1; i <= kStages; ++i) {
    const double top = now.velocity + (wanted - now.velocity) * i / kStages;
    if (can_level_off(now, top, limits)) {
      consider(top);
    }
  }
  return best;
}

// The pace was rising to more than is requested now: first it levels off as low as possible.
Profile PaceChange::no_faster(const LineState& now, double wanted, const PaceLimits& limits) noexcept {
  const double before = top_;
  for (int i = kStages - 1; i >= 0; --i) {
    const double lower = now.velocity + (before - now.velocity) * i / kStages;
    top_ = can_level_off(now, lower, limits) ? lower : top_;
  }
  return Profile::to_velocity(now, std::min(wanted, top_), limits.at(top_));
}

Profile PaceChange::next(const LineState& now, double wanted, double seconds, const PaceLimits& limits) noexcept {
  if (now.acceleration < 0 || (now.acceleration <= 0 && wanted <= now.velocity)) {
    const LineLimits here = limits.at(now.velocity);
    return Profile::to_velocity(now, std::min(wanted, std::max(unloaded(now, here), 0.0)), here);
  }
  return now.acceleration > 0 && wanted < top_ ? no_faster(now, wanted, limits) : faster(now, wanted, seconds, limits);
}

}  // namespace indurop::robot
