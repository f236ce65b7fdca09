// SPDX-License-Identifier: Apache-2.0
// Blending of one piece of the path into the next: whether it is possible, and how fast.

#include <algorithm>

#include "control/robot/path/follower.h"

namespace indurop::robot {

// Whether the first two segments are blended is decided once, before the first one is too near its end to reach the
// blend's speed.
void Follower::try_blend() noexcept {
  if (in_blend_ || blend_.zone > 0 || stopping() || segment(0).timed) {
    return;
  }
  Blend wanted = blends_[1];
  if (wanted.zone <= 0) {
    return;
  }
  // The second segment may be the last: it must be possible to stop on it.
  const double rest = segment(1).length - wanted.zone;
  double& speed = wanted.limits.velocity;
  while (speed > kStill && ramp({0, speed, 0}, 0, segment(1).limits).distance > rest) {
    speed *= 0.9;
  }
  const double left = segment(0).length - wanted.zone - state_.position;
  const bool in_time = left > 0 && (state_.velocity <= 0 ||
                                    ramp(state_, std::min(speed, state_.velocity), segment(0).limits).distance <= left);
  if (speed > kStill && in_time) {
    blend_ = wanted;
    to_end_ = false;
    replan();
  }
}

// Plans to the beginning of the blend, at the lowest possible speed there: braking that is not finished would continue
// in the blend, which allows less.
Profile Follower::into_blend() const noexcept {
  constexpr int kHalvings = 8;
  LineLimits limits = piece_limits();
  limits.velocity = std::min(limits.velocity, std::max(state_.velocity, unloaded(state_, limits)));
  const auto to = [&](double speed) { return Profile::to_position(state_, piece_end(), speed, limits); };
  double fast = blend_.limits.velocity;
  double slow = 0;
  Profile result = to(fast);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (fast + slow) / 2;
    const Profile slower = to(middle);
    if (slower.overshoots()) {
      slow = middle;
    } else {
      fast = middle;
      result = slower;
    }
  }
  return result;
}

}  // namespace indurop::robot
