// SPDX-License-Identifier: Apache-2.0
// Blending of one piece of the path into the next: whether it is possible, and how fast.

#include <algorithm>

#include "control/robot/path/followed_path.h"

namespace indurop::robot {

double blend_speed(const Blend& blend, const Segment& next) noexcept {
  const double rest = next.length - blend.zone;
  double speed = blend.limits.velocity;
  while (speed > FollowedPath::kStill && ramp({0, speed, 0}, 0, next.limits).distance > rest) {
    speed *= 0.9;
  }
  return speed;
}

// This is decided once, before the first segment is too near its end to reach the blend's speed.
bool FollowedPath::begin_blend() noexcept {
  if (pieces_.count < 2 || in_blend() || blend().zone > 0 || segment().timed) {
    return false;
  }
  const Segment& next = pieces_.segments[1];
  Blend wanted = pieces_.blends[1];
  if (wanted.zone <= 0) {
    return false;
  }
  const double speed = wanted.limits.velocity = blend_speed(wanted, next);
  const double left = segment().length - wanted.zone - state_.position;
  const bool in_time = left > 0 && (state_.velocity <= 0 ||
                                    ramp(state_, std::min(speed, state_.velocity), segment().limits).distance <= left);
  if (speed > kStill && in_time) {
    pieces_.blend = wanted;
    return true;
  }
  return false;
}

// Braking that is not finished would continue in the blend, which allows less.
Profile FollowedPath::into_blend() const noexcept {
  constexpr int kHalvings = 8;
  LineLimits limits = piece_limits();
  limits.velocity = std::min(limits.velocity, std::max(state_.velocity, unloaded(state_, limits)));
  const auto to = [&](double speed) { return Profile::to_position(state_, piece_end(), speed, limits); };
  double fast = blend().limits.velocity;
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
