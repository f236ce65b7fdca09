// SPDX-License-Identifier: Apache-2.0
// Leaving a path before its end, and returning to it.

#include <algorithm>

#include "control/robot/path/followed_path.h"

namespace indurop::robot {

namespace {

// The rest of a path was not checked as a motion that begins there, so it is followed at a reduced speed.
constexpr double kGently = 0.7;

}  // namespace

void PathPieces::copy(const PathPieces& other) noexcept {
  count = other.count;
  std::copy_n(other.segments.begin(), static_cast<std::size_t>(count), segments.begin());
  std::copy_n(other.blends.begin(), static_cast<std::size_t>(count), blends.begin());
  blend = other.blend;
  in_blend = other.in_blend;
}

void FollowedPath::keep(const Joints& q, KeptPath& kept) const noexcept {
  kept.pieces.copy(pieces_);
  kept.place = state_.position;
  kept.q = q;
  if (!empty()) {
    static_cast<void>(joints_at(state_.position, q, kept.q));  // braking computes the path only up to rounding
  }
}

int KeptPath::source() const noexcept {
  if (!known()) {
    return 0;
  }
  const Segment& left = pieces.segments[0];
  if (left.chain == nullptr) {
    return left.source;
  }
  return left.chain->source_at(left.timed ? left.timing.at(place).place : place);
}

void FollowedPath::take(KeptPath& kept) noexcept {
  pieces_.copy(kept.pieces);
  kept.pieces.count = 0;
  state_ = {kept.place, 0, 0};
  Segment& s = segment();
  if (joints_timed()) {
    // The same path again, at a pace that leaves a margin for changes of the pace.
    s.made_for = std::min(s.made_for, 1 - 1e-9);
    s.fastest = std::min(s.fastest, kGently);
    s.settled = 0;
    s.moving = kept.place > 0;
  } else if (s.timed) {
    passed_.fill(s.timing.at(kept.place).place);
  } else if (!s.left) {
    s.left = true;
    s.limits = {kGently * s.limits.velocity, kGently * kGently * s.limits.acceleration,
                kGently * kGently * kGently * s.limits.jerk};
  }
}

}  // namespace indurop::robot
