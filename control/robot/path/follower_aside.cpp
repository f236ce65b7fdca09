// SPDX-License-Identifier: Apache-2.0
// Resuming a path that was left before its end, from where it was left.

#include <algorithm>

#include "control/robot/path/follower.h"

namespace indurop::robot {

namespace {

// The rest of a path was not checked as a motion that begins there, so it is followed at a reduced speed.
constexpr double kGently = 0.7;

}  // namespace

void Follower::set_aside() noexcept {
  keep_ = true;
  if (idle()) {
    put_aside();
  }
}

void Follower::put_aside() noexcept {
  keep_ = false;
  const auto count = static_cast<std::size_t>(count_);
  std::copy_n(segments_.begin(), count, aside_.segments.begin());
  std::copy_n(blends_.begin(), count, aside_.blends.begin());
  aside_.count = count_;
  aside_.blend = blend_;
  aside_.in_blend = in_blend_;
  aside_.place = state_.position;
  aside_.q = q_;
  if (count_ > 0) {
    static_cast<void>(joints_on_piece(state_.position, q_, aside_.q));  // braking computes the path only up to rounding
  }
}

void Follower::go_on() noexcept {
  reset(aside_.q);
  const auto count = static_cast<std::size_t>(aside_.count);
  std::copy_n(aside_.segments.begin(), count, segments_.begin());
  std::copy_n(aside_.blends.begin(), count, blends_.begin());
  count_ = aside_.count;
  blend_ = aside_.blend;
  in_blend_ = aside_.in_blend;
  aside_.count = 0;
  if (count_ == 0) {
    return;
  }
  state_ = {aside_.place, 0, 0};
  pace_ = {};
  Segment& s = segments_[0];
  if (s.timed && s.move == Move::Joint) {
    // The same path again, at a pace that leaves a margin for changes of the pace.
    s.made_for = std::min(s.made_for, 1 - 1e-9);
    s.fastest = std::min(s.fastest, kGently);
    s.settled = 0;
    s.tip_speed = measured_tip_speed(s);
    s.moving = aside_.place > 0;
  } else if (s.timed) {
    passed_.fill(s.timing.at(aside_.place).place);
  } else if (!s.left) {
    s.left = true;
    s.limits = {kGently * s.limits.velocity, kGently * kGently * s.limits.acceleration,
                kGently * kGently * kGently * s.limits.jerk};
  }
  replan();
}

// In a blend, the present motion is the one before it.
PathPlace Follower::path_place() const noexcept {
  if (idle()) {
    return {};
  }
  const Segment& s = segment(0);
  double part = 0;
  if (s.timed && s.move != Move::Joint) {
    part = s.stretch > 0 ? s.timing.at(state_.position).place / s.stretch : 1;
  } else {
    double first = state_.position;
    if (in_blend_) {
      double second = 0;
      blend_.parts_at(state_.position, first, second);
      first += s.length;
    }
    part = s.length > 0 ? first / s.length : 1;
  }
  return {s.ticket, part * s.way, (1 - part) * s.way, to_go()};
}

}  // namespace indurop::robot
