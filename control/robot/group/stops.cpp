// SPDX-License-Identifier: Apache-2.0
// Stops the group after an error, and resets it. It stays on its path if that can still be followed, even if
// an axis has no power; otherwise its axes brake in step.

#include <algorithm>
#include <cmath>

#include "control/robot/group/group.h"

namespace indurop::robot {

namespace {

// Returns whether an error leaves the path unchanged: the other axes can still follow it.
bool keeps_path(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::Emergency:
    case ErrorCode::Contact:
    case ErrorCode::Drive:
    case ErrorCode::Power:
    case ErrorCode::Following:
    case ErrorCode::Planner:
      return true;
    default:
      return false;
  }
}

// Returns whether the check ahead has ensured that each axis can brake on its own.
bool is_foreseen(ErrorCode code) noexcept {
  return code == ErrorCode::Collision || code == ErrorCode::Workspace;
}

}  // namespace

// Stops everything: along the path if there is one and it can still be followed, else without it.
void Group::trip(ErrorCode code, int axis, double hardness) noexcept {
  set_job_aside();
  job_.fail({code, axis}, code == ErrorCode::Contact ? contact_text_ : to_string(code),
            std::max(follower_.source(), 0));
  finish_service(code, axis);
  error_ = code;
  error_axis_ = axis;
  drop_motions(code);
  forget_plans();
  enabling_ = false;
  state_ = GroupState::Stopping;
  to_error_ = true;
  release_stop();
  hardness_ = std::max(hardness_, hardness);
  const bool cut = code == ErrorCode::Emergency && parts_.settings.emergency_category == StopCategory::Category0;
  for (AxisControl& a : axes()) {
    a.power(a.wants_power() && !cut);
  }
  const bool on_it = !follower_.idle() && !tracking_.on() && on_path_;
  if (!on_it || !keeps_path(code) || cut) {
    leave_path(code);
    return;
  }
  follower_.stop_hard(hardness_);
  for (AxisControl& a : axes()) {
    if (!a.in_group()) {
      a.fail(code, hardness_);
    }
  }
}

// The path or a set point is not possible; during a stop the first error remains the reported one.
void Group::fall_off(ErrorCode code, int axis) noexcept {
  if (to_error_) {
    leave_path(error_);
  } else {
    trip(code, axis, 1);
  }
}

// The gates know speed and acceleration of the axes as their drives do, so they can brake whatever error occurred
// before.
void Group::leave_path(ErrorCode code) noexcept {
  const bool alone = std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.busy(); });
  drop_ride(code);
  follower_.reset(commanded());
  begin_braking(!alone && !is_foreseen(code));
  for (AxisControl& a : axes()) {
    a.fail(code, hardness_);
  }
}

void Group::begin_braking(bool in_step) noexcept {
  on_path_ = false;
  braking_ = true;
  in_step_ = in_step;
  if (!in_step) {
    return;
  }
  std::array<Joints, 3> past;
  past.fill(Joints::Zero());
  for (int i = 0; i < count(); ++i) {
    const LineState& last = gates_[at(i)].state();
    const double before = last.velocity - last.acceleration * period_;
    past[0][i] = last.position;
    past[1][i] = last.position - last.velocity * period_;
    past[2][i] = past[1][i] - before * period_;
  }
  brake_.begin(past, period_, hardness_);
}

// Computes the next set points. An axis that cannot brake in step within its limits, or before its end, brakes on its
// own.
void Group::brake_axes() noexcept {
  const Joints q = in_step_ ? brake_.next() : Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    SetPointGate& gate = gates_[at(i)];
    if (in_step_ && !axes_[at(i)].placed_anew() && gate.check(q[i], hardness_) == ErrorCode::Ok) {
      gate.pass(q[i], hardness_);
    } else {
      gate.brake(hardness_);
    }
    axes_[at(i)].put(gate.state());
  }
}

// Comes to rest on the path, then enters ErrorStop.
void Group::stop_for(Fault fault) noexcept {
  error_ = fault.code;
  error_axis_ = fault.axis;
  forget_plans();
  follower_.stop();
  state_ = GroupState::Stopping;
  to_error_ = true;
}

void Group::run_stopping() noexcept {
  if (on_path_) {
    follow_path();
  }
  const bool rest = std::all_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.at_rest(); });
  if (on_path_ ? !follower_.idle() || tracking_.on() : !rest) {
    return;
  }
  if (to_error_) {
    state_ = GroupState::ErrorStop;
    for (AxisControl& a : axes()) {
      a.rest();
      a.fail(error_, 1);
    }
    quick_stop_ = error_ == ErrorCode::Emergency || error_ == ErrorCode::Planner;
  } else if (to_disabled_) {
    state_ = GroupState::Disabled;
    come_to_standby();
    state_ = GroupState::Disabled;
    for (AxisControl& a : axes()) {
      a.give_up_power();
    }
    finish_service(ErrorCode::Ok);
  } else if (stop_ != CommandTable::kNone && table_.execute(stop_)) {
    table_.holds(stop_);
    return;
  } else {
    come_to_standby();
    finish_service(ErrorCode::Ok);
  }
  release_stop();
  to_error_ = to_disabled_ = false;
  on_path_ = true;
}

// Acknowledges the fault of one drive after another. Returns false while one of them still has its fault; if that takes
// too long, the service ends.
bool Group::clear_faults() noexcept {
  constexpr double kTime = 4;  // s
  for (int i = 0; i < count(); ++i) {
    AxisControl& a = axes_[at(i)];
    if (a.drive().faulty()) {
      a.reset();
      if (waited_ > kTime) {
        finish_service(ErrorCode::Drive, i + 1);
      }
      return false;
    }
  }
  // An axis that has not reached its set point yet would trip again.
  if (const int behind = axis_behind(); behind >= 0) {
    if (waited_ > kTime) {
      finish_service(ErrorCode::Following, behind + 1);
    }
    return false;
  }
  return true;
}

// Called again in every period until the robot is at standstill and the drives have left their faults. Drives have
// faults without power, too.
ErrorCode Group::reset() noexcept {
  if (to_error_) {
    // PLCopen: reset only at standstill.
    return emergency_ ? ErrorCode::Emergency : ErrorCode::Ok;
  }
  const bool faulty =
      std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.drive().faulty(); });
  if (state_ != GroupState::ErrorStop && !faulty) {
    if (enabling_ && !letting_go_) {
      take_power();
    }
    finish_service(ErrorCode::Ok);
    return ErrorCode::Ok;
  }
  if (emergency_) {
    return ErrorCode::Emergency;
  }
  waited_ += period_;
  if (!clear_faults() || state_ != GroupState::ErrorStop) {
    return ErrorCode::Ok;
  }
  // A drive that is stopped in an emergency is about to lose its power, whatever it reports now.
  const bool has_power = error_ != ErrorCode::Emergency && all_enabled();
  quick_stop_ = false;
  contact_.release();
  for (AxisControl& a : axes()) {
    a.reset();
  }
  state_ = GroupState::Disabled;
  if (has_power) {
    come_to_standby();
  } else {
    for (AxisControl& a : axes()) {
      a.give_up_power();
    }
  }
  finish_service(ErrorCode::Ok);
  return ErrorCode::Ok;
}

void Group::go_on_resetting() noexcept {
  if (!active_ || service_ != Service::GroupReset) {
    return;
  }
  if (const ErrorCode code = reset(); code != ErrorCode::Ok) {
    finish_service(code);
  }
}

}  // namespace indurop::robot
