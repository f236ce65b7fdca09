// SPDX-License-Identifier: Apache-2.0
// The last checks before the drives: one for each axis, and one for the box that the tool must not leave.

#include <algorithm>

#include "control/robot/group/group.h"

namespace indurop::robot {

// Paths were planned inside the box, and a stop follows them. Single axes have to be able to come to rest inside.
bool Group::leaves_workspace() const noexcept {
  const Workspace& box = places_.box();
  const bool placed = std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.placed_anew(); });
  if (!box.known() || placed) {
    return false;
  }
  Joints last = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    last[i] = gates_[at(i)].state().position;
  }
  const Vec3 next = places_.arm().forward(commanded()).position;
  const bool alone = std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.busy(); });
  return box.left(places_.arm().forward(last).position, next) || ((alone || tracking_.on()) && !rests_inside(next));
}

// Returns whether the tool comes to rest inside the box if all axes brake at once.
bool Group::rests_inside(const Vec3& start) const noexcept {
  constexpr int kLooks = 12;
  std::array<Profile, kAxes> stops;
  double longest = 0;
  for (int i = 0; i < count(); ++i) {
    const LineLimits limits{parts_.joints.velocity[i], parts_.joints.acceleration[i], parts_.joints.jerk[i]};
    stops[at(i)] = Profile::to_velocity(axes_[at(i)].commanded(), 0, limits);
    longest = std::max(longest, stops[at(i)].duration());
  }
  WayInside way(places_.box(), start);
  for (int k = 1; k <= kLooks; ++k) {
    Joints q = Joints::Zero();
    for (int i = 0; i < count(); ++i) {
      q[i] = stops[at(i)].at(longest * k / kLooks).position;
    }
    if (!way.next(places_.arm().forward(q).position)) {
      return false;
    }
  }
  return true;
}

// Every set point passes through here before it reaches a drive.
void Group::pass_gates() noexcept {
  for (int i = 0; i < count(); ++i) {
    if (axes_[at(i)].placed_anew()) {
      gates_[at(i)].stand(axes_[at(i)].commanded().position);
    }
  }
  for (int i = 0; i < count() && !braking_; ++i) {
    const AxisControl& a = axes_[at(i)];
    const bool by_itself = a.brakes() || a.led_by_drive();
    const ErrorCode code = by_itself ? ErrorCode::Ok : gates_[at(i)].check(a.commanded().position, hardness_);
    if (code != ErrorCode::Ok) {
      fall_off(code, i + 1);
    }
  }
  if (!braking_ && leaves_workspace()) {
    fall_off(ErrorCode::Workspace, 0);
  }
  if (!braking_ && tip_too_fast()) {
    fall_off(ErrorCode::Speed, 0);
  }
  if (!braking_) {
    look_ahead();
  }
  if (braking_) {
    brake_axes();
  }
  for (int i = 0; i < count() && !braking_; ++i) {
    if (axes_[at(i)].led_by_drive()) {
      gates_[at(i)].follow(axes_[at(i)].commanded().position, axes_[at(i)].commanded().velocity);
    } else if (axes_[at(i)].brakes()) {
      gates_[at(i)].brake(1);
      axes_[at(i)].braked(gates_[at(i)].state());
    } else {
      gates_[at(i)].pass(axes_[at(i)].commanded().position, hardness_);
    }
  }
  if (std::all_of(gates_.begin(), gates_.end(), [](const SetPointGate& g) { return g.at_rest(); })) {
    braking_ = false;
    hardness_ = state_ == GroupState::Stopping ? hardness_ : 1;
  }
}

}  // namespace indurop::robot
