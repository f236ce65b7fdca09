// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/last_gate.h"

#include <array>

#include "control/robot/group/fault_text.h"
#include "control/robot/kinematics/tip_speed.h"

namespace indurop::robot {

// Paths were planned inside the box, and a stop follows them. Single axes have to be able to come to rest inside.
bool LastGate::leaves_workspace() const noexcept {
  const Workspace& box = robot_.tool.places().box();
  if (!box.known() || robot_.axes.any_displaced()) {
    return false;
  }
  const Vec3 last = robot_.tip(robot_.axes.passed()).position;
  const Vec3 next = robot_.tip(robot_.commanded()).position;
  return box.left(last, next) || ((robot_.axes.any_busy() || off_path_.any()) && !rests_inside(next));
}

// Returns whether the tool comes to rest inside the box if all axes brake at once.
bool LastGate::rests_inside(const Vec3& start) const noexcept {
  constexpr int kSamples = 12;
  std::array<Profile, kAxes> stops;
  const double longest = robot_.axes.stops(stops);
  WayInside way(robot_.tool.places().box(), start);
  for (int k = 1; k <= kSamples; ++k) {
    Joints q = Joints::Zero();
    for (int i = 0; i < robot_.count(); ++i) {
      q[i] = stops[at(i)].at(longest * k / kSamples).position;
    }
    if (!way.next(robot_.tip(q).position)) {
      return false;
    }
  }
  return true;
}

// Returns whether neither the tip nor the arm's end gets too fast if each axis brakes on its own from here.
bool LastGate::rests_slowly() const noexcept {
  constexpr int kSamples = 16;
  constexpr double kRestPart = 0.94;  // of the limit; it may be faster between two of them
  std::array<Profile, kAxes> stops;
  const double longest = robot_.axes.stops(stops);
  TipSpeed tip(robot_.tool.arm());
  for (int k = 0; k < kSamples; ++k) {
    const double time = longest * k / kSamples;
    Joints from = Joints::Zero();
    Joints to = Joints::Zero();
    for (int i = 0; i < robot_.count(); ++i) {
      from[i] = stops[at(i)].at(time).position;
      to[i] = stops[at(i)].at(time + robot_.period).position;
    }
    tip.go_on_from(from);
    tip.note(to);
  }
  return tip.farthest() <= kRestPart * kReducedSpeed * robot_.period;
}

bool LastGate::passes(int axis) const noexcept {
  return robot_.axes.gate(axis).check(robot_.axes[axis].commanded().position, 1) == ErrorCode::Ok;
}

bool LastGate::passes() noexcept {
  return !leaves_workspace() && rests_slowly() && clear_.foresee().ok();
}

void LastGate::check_axes() noexcept {
  for (int i = 0; i < robot_.count() && !braking_; ++i) {
    const AxisControl& a = robot_.axes[i];
    const bool on_its_own = a.brakes() || a.led_by_drive();
    const ErrorCode code = on_its_own ? ErrorCode::Ok : robot_.axes.gate(i).check(a.commanded().position, hardness_);
    if (code != ErrorCode::Ok) {
      group_.fall_off(code, i + 1);
    }
  }
}

void LastGate::check_clear() noexcept {
  if (const Fault fault = clear_.step(off_path_.any()); !fault.ok()) {
    FaultText why;
    describe(fault, robot_.tool.places().clearance(), why);
    group_.trip(fault.code, 0, 1);
    robot_.job.set_message(why);
  }
}

void LastGate::check_space() noexcept {
  if (robot_.states.powered() && !space_.foresee(off_path_.any())) {
    group_.trip(ErrorCode::Collision, 0, 1);
    robot_.job.set_message(space_.text());
  }
}

void LastGate::pass() noexcept {
  for (int i = 0; i < robot_.count(); ++i) {
    if (robot_.axes[i].displaced()) {
      robot_.axes.gate(i).stand(robot_.axes[i].commanded().position);
    }
  }
  check_axes();
  if (!braking_ && leaves_workspace()) {
    group_.fall_off(ErrorCode::Workspace, 0);
  }
  if (!braking_ && mode_.tip_too_fast(off_path_.any())) {
    group_.fall_off(ErrorCode::Speed, 0);
  }
  if (!braking_) {
    check_clear();
  }
  if (!braking_) {
    check_space();
  }
  if (braking_) {
    brake();
  } else {
    send();
  }
  space_.step(off_path_.any());
  if (robot_.axes.gates_at_rest()) {
    braking_ = false;
    hardness_ = robot_.states.stopping() ? hardness_ : 1;
  }
}

void LastGate::send() noexcept {
  for (int i = 0; i < robot_.count(); ++i) {
    AxisControl& a = robot_.axes[i];
    SetPointGate& gate = robot_.axes.gate(i);
    if (a.led_by_drive()) {
      gate.follow(a.commanded().position, a.commanded().velocity);
    } else if (a.brakes()) {
      gate.brake(1);
      a.braked(gate.state());
    } else {
      gate.pass(a.commanded().position, hardness_);
    }
  }
}

void LastGate::begin_braking(bool in_step) noexcept {
  robot_.states.leave_path();
  braking_ = true;
  in_step_ = in_step;
  if (!in_step) {
    return;
  }
  std::array<Joints, 3> past;
  past.fill(Joints::Zero());
  for (int i = 0; i < robot_.count(); ++i) {
    const LineState& last = robot_.axes.gate(i).state();
    const double before = last.velocity - last.acceleration * robot_.period;
    past[0][i] = last.position;
    past[1][i] = last.position - last.velocity * robot_.period;
    past[2][i] = past[1][i] - before * robot_.period;
  }
  brake_.begin(past, robot_.period, hardness_);
}

// Computes the next set points. An axis that cannot brake in step within its limits, or before its end, brakes on its
// own.
void LastGate::brake() noexcept {
  const Joints q = in_step_ ? brake_.next() : Joints::Zero();
  for (int i = 0; i < robot_.count(); ++i) {
    SetPointGate& gate = robot_.axes.gate(i);
    if (in_step_ && !robot_.axes[i].displaced() && gate.check(q[i], hardness_) == ErrorCode::Ok) {
      gate.pass(q[i], hardness_);
    } else {
      gate.brake(hardness_);
    }
    robot_.axes[i].put(gate.state());
  }
}

}  // namespace indurop::robot
