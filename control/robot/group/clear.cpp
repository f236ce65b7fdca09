// SPDX-License-Identifier: Apache-2.0
// Collision check for axes that move as single axes or follow others, and for arms that track a belt: their path was
// not planned, so in each period they must be able to come to rest before anything touches.

#include <algorithm>

#include "control/robot/group/group.h"

namespace indurop::robot {

void Group::look_ahead() noexcept {
  const bool alone =
      tracking_.on() || std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.busy(); });
  const bool placed = std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.placed_anew(); });
  if (!alone || placed || !places_.clearance().known() || state_ == GroupState::Homing) {
    looks_ahead_ = false;
    return;
  }
  if (const Fault fault = stays_clear(); !fault.ok()) {
    looks_ahead_ = false;
    char why[kWhy];
    describe(fault, why);
    trip(fault.code, 0, 1);
    job_.say(why);
  }
}

// Checks the way from the last set point to this one, and on to rest if all axes brake at once. The one before was
// checked in the same way, so the gates can still brake there.
Fault Group::stays_clear() noexcept {
  constexpr int kLooks = 24;
  constexpr double kParts = 4;  // of the way to rest: the longest step
  Joints last = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    last[i] = gates_[at(i)].state().position;
  }
  const Joints next = commanded();
  if (!looks_ahead_) {
    clear_.begin(last, tool_);
    looks_ahead_ = true;
  }
  ClearWalk walk;
  walk.begin(1, 1);
  if (!walk.all(clear_, kLooks, [&](double place, const Joints&, Joints& q) {
        q = last + place * (next - last);
        return true;
      })) {
    return {ErrorCode::Collision, 0, clear_.pair(), -1};
  }
  std::array<Profile, kAxes> stops;
  double longest = 0;
  for (int i = 0; i < count(); ++i) {
    const LineLimits limits{parts_.joints.velocity[i], parts_.joints.acceleration[i], parts_.joints.jerk[i]};
    stops[at(i)] = Profile::to_velocity(axes_[at(i)].commanded(), 0, limits);
    longest = std::max(longest, stops[at(i)].duration());
  }
  to_rest_.take(clear_);
  walk.begin(longest, longest / kParts);
  if (!walk.all(to_rest_, kLooks, [&](double time, const Joints&, Joints& q) {
        q = next;
        for (int i = 0; i < count(); ++i) {
          q[i] = stops[at(i)].at(time).position;
        }
        return true;
      })) {
    return {ErrorCode::Collision, 0, to_rest_.pair(), -1};
  }
  return {};
}

}  // namespace indurop::robot
