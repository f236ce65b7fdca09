// SPDX-License-Identifier: Apache-2.0
// Operating modes (ISO 10218-1). In manual mode neither the tool's tip nor the arm's end is faster than 250 mm/s, and
// everything comes to rest when the enabling switch is released. A stopped motion continues only on request.

#include <algorithm>
#include <cmath>

#include "control/robot/group/group.h"

namespace indurop::robot {

namespace {

constexpr double kPlanned = 0.98 * kReducedSpeed;  // m/s; the motion may be faster between two checked places

}  // namespace

bool Group::stands() const noexcept {
  const bool busy = std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.busy(); });
  return !busy && (state_ == GroupState::Disabled || state_ == GroupState::Standby || state_ == GroupState::ErrorStop);
}

void Group::serve_mode(const ModeRequest& asked) noexcept {
  const bool known = asked.mode >= OperatingMode::Any && asked.mode <= OperatingMode::Manual;
  const OperatingMode wanted = known ? asked.mode : OperatingMode::Manual;
  const bool held = enabling_switch_.holds(asked.enabled, asked.beat, period_) && known;
  mode_ = stands() ? wanted : mode_;
  const ErrorCode before = permit_;
  permit_ = wanted != mode_                           ? ErrorCode::Mode
            : mode_ == OperatingMode::Manual && !held ? ErrorCode::Enabling
                                                      : ErrorCode::Ok;
  if (permit_ != ErrorCode::Ok && before == ErrorCode::Ok && !stands()) {
    rest_for(permit_);
  }
}

// Comes to rest on the path; power stays on (stop category 2). The person who releases the switch may be in danger.
void Group::rest_for(ErrorCode code) noexcept {
  if (to_error_) {
    return;
  }
  set_job_aside();
  if (job_.running()) {
    job_.stop();
    job_.say(to_string(code));
  }
  finish_service(code);
  drop_motions(code);
  forget_plans();
  if (state_ == GroupState::Moving || (state_ == GroupState::Stopping && on_path_)) {
    if (code == ErrorCode::Enabling && tracking_.on()) {
      drop_ride(code);
      follower_.reset(commanded());
      hardness_ = parts_.settings.emergency_factor;
      begin_braking(true);
    } else if (code == ErrorCode::Enabling) {
      hardness_ = parts_.settings.emergency_factor;
      follower_.stop_hard(hardness_);
    } else {
      follower_.stop();
    }
  } else {
    follower_.reset(commanded());
    on_path_ = false;
    for (AxisControl& a : axes()) {
      a.halt();
    }
  }
  state_ = powered() ? GroupState::Stopping : state_;
}

double Group::tip_limit() const noexcept {
  return reduced() ? kPlanned : HUGE_VAL;
}

// For single axes: the part of their full speed at which the tip and the arm's end keep the limit, even if all moving
// axes are as fast as they can be.
double Group::axes_pace() const noexcept {
  if (!reduced()) {
    return 1;
  }
  const Jacobian tip = places_.arm().jacobian(commanded());
  const Jacobian end = tools_.arm(0).jacobian(commanded());
  double most = 0;
  for (int i = 0; i < count(); ++i) {
    if (axes_[static_cast<std::size_t>(i)].busy()) {
      most += parts_.joints.velocity[i] * std::max(tip.col(i).head<3>().norm(), end.col(i).head<3>().norm());
    }
  }
  return most > kPlanned ? kPlanned / most : 1;
}

// The check of the last gate, for the set points that are about to be sent.
bool Group::tip_too_fast() const noexcept {
  if (mode_ != OperatingMode::Manual || !powered() || state_ == GroupState::Homing) {
    return false;
  }
  Joints last = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    last[i] = gates_[static_cast<std::size_t>(i)].state().position;
  }
  TipSpeed tip(places_.arm());
  tip.begin(last);
  tip.note(commanded());
  // The path on which a belt carries the arm was not planned, so axes may move against each other.
  return (tracking_.on() ? tip.farthest() : tip.moved()) > kReducedSpeed * period_;
}

ErrorCode Group::axis_permit() const noexcept {
  return powered() && state_ != GroupState::Standby ? ErrorCode::State : permit_;
}

}  // namespace indurop::robot
