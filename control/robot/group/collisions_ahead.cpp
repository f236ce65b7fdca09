// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/collisions_ahead.h"

#include <array>

namespace indurop::robot {

Fault CollisionsAhead::step(bool off_path) noexcept {
  const bool alone = off_path || robot_.axes.any_busy();
  if (!alone || robot_.axes.any_displaced() || !robot_.tool.places().clearance().known() ||
      robot_.states.is(GroupState::Homing)) {
    begun_ = false;
    return {};
  }
  const Fault fault = check();
  begun_ = fault.ok();
  return fault;
}

// Checks the way from the last set point to this one, and on to rest if all axes brake at once. The one before was
// checked in the same way, so the gates can still brake there.
Fault CollisionsAhead::check() noexcept {
  constexpr int kSamples = 24;
  constexpr double kParts = 4;  // of the way to rest: the longest step
  const Joints last = robot_.axes.passed();
  const Joints next = robot_.commanded();
  if (!begun_) {
    clear_.begin(last, robot_.tool.number());
  }
  ClearWalk walk;
  walk.begin(1, 1);
  if (!walk.all(clear_, kSamples, [&](double place, const Joints&, Joints& q) {
        q = last + place * (next - last);
        return true;
      })) {
    return {ErrorCode::Collision, 0, clear_.pair(), -1};
  }
  std::array<Profile, kAxes> stops;
  const double longest = robot_.axes.stops(stops);
  to_rest_.take(clear_);
  walk.begin(longest, longest / kParts);
  if (!walk.all(to_rest_, kSamples, [&](double time, const Joints&, Joints& q) {
        q = next;
        for (int i = 0; i < robot_.count(); ++i) {
          q[i] = stops[at(i)].at(time).position;
        }
        return true;
      })) {
    return {ErrorCode::Collision, 0, to_rest_.pair(), -1};
  }
  return {};
}

}  // namespace indurop::robot
