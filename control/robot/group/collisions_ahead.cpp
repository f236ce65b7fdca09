// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/collisions_ahead.h"

#include <array>

namespace indurop::robot {

namespace {

constexpr int kMostSteps = 24;

}  // namespace

bool CollisionsAhead::is_needed() const noexcept {
  return !robot_.axes.any_displaced() && robot_.tool.places().clearance().known() &&
         !robot_.states.is(GroupState::Homing);
}

Fault CollisionsAhead::step(bool off_path) noexcept {
  const bool alone = off_path || robot_.axes.any_busy();
  if (!alone || !is_needed()) {
    begun_ = false;
    return {};
  }
  const Fault fault = check();
  begun_ = fault.ok();
  return fault;
}

Fault CollisionsAhead::foresee() noexcept {
  if (!is_needed()) {
    return {};
  }
  if (!begun_) {
    clear_.begin(robot_.axes.passed(), robot_.tool.number());
  }
  to_rest_.take(clear_);
  const Fault fault = advance(to_rest_);
  return fault.ok() ? rest(to_rest_) : fault;
}

// Checks the way from the last set point to this one, and on to rest if all axes brake at once. The one before was
// checked in the same way, so the gates can still brake there.
Fault CollisionsAhead::check() noexcept {
  if (!begun_) {
    clear_.begin(robot_.axes.passed(), robot_.tool.number());
  }
  if (const Fault fault = advance(clear_); !fault.ok()) {
    return fault;
  }
  to_rest_.take(clear_);
  return rest(to_rest_);
}

Fault CollisionsAhead::advance(CollisionCheck& way) const noexcept {
  const Joints last = robot_.axes.passed();
  const Joints next = robot_.commanded();
  ClearWalk walk;
  walk.begin(1, 1);
  const bool clear = walk.all(way, kMostSteps, [&](double place, const Joints&, Joints& q) {
    q = last + place * (next - last);
    return true;
  });
  return clear ? Fault{} : Fault{ErrorCode::Collision, 0, way.pair(), -1};
}

Fault CollisionsAhead::rest(CollisionCheck& way) const noexcept {
  constexpr double kParts = 4;  // of the way to rest: the longest step
  const Joints next = robot_.commanded();
  std::array<Profile, kAxes> stops;
  const double longest = robot_.axes.stops(stops);
  ClearWalk walk;
  walk.begin(longest, longest / kParts);
  const bool clear = walk.all(way, kMostSteps, [&](double time, const Joints&, Joints& q) {
    q = next;
    for (int i = 0; i < robot_.count(); ++i) {
      q[i] = stops[at(i)].at(time).position;
    }
    return true;
  });
  return clear ? Fault{} : Fault{ErrorCode::Collision, 0, way.pair(), -1};
}

}  // namespace indurop::robot
