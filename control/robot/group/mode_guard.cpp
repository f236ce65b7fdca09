// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/mode_guard.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kPlanned = 0.98 * kReducedSpeed;  // m/s; the motion may be faster between two checked places

}  // namespace

bool ModeGuard::at_standstill() const noexcept {
  const GroupStates& states = robot_.states;
  return !robot_.axes.any_busy() && !robot_.singles.any_busy() && !states.busy();
}

ErrorCode ModeGuard::step(const ModeRequest& request) noexcept {
  const bool known = request.mode >= OperatingMode::Any && request.mode <= OperatingMode::Manual;
  const OperatingMode wanted = known ? request.mode : OperatingMode::Manual;
  const bool held = enabling_switch_.holds(request.enabled, request.beat, robot_.period) && known;
  mode_ = at_standstill() ? wanted : mode_;
  const ErrorCode before = permit_;
  permit_ = wanted != mode_                           ? ErrorCode::Mode
            : mode_ == OperatingMode::Manual && !held ? ErrorCode::Enabling
                                                      : ErrorCode::Ok;
  return before == ErrorCode::Ok && !at_standstill() ? permit_ : ErrorCode::Ok;
}

double ModeGuard::tip_limit(bool jogging) const noexcept {
  return reduced(jogging) ? kPlanned : HUGE_VAL;
}

double ModeGuard::axes_pace(bool jogging) const noexcept {
  if (!reduced(jogging)) {
    return 1;
  }
  const Jacobian tip = robot_.tool.arm().jacobian(robot_.commanded());
  const Jacobian end = robot_.tool.bare_arm().jacobian(robot_.commanded());
  double most = 0;
  for (int i = 0; i < robot_.count(); ++i) {
    if (robot_.axes[i].busy()) {
      most += robot_.parts.joints.velocity[i] * std::max(tip.col(i).head<3>().norm(), end.col(i).head<3>().norm());
    }
  }
  return most > kPlanned ? kPlanned / most : 1;
}

double ModeGuard::single_pace(int axis) const noexcept {
  const bool limited = mode_ == OperatingMode::Manual && robot_.parts.singles[at(axis)].slides();
  return limited ? std::min(1.0, kPlanned / robot_.parts.single_limits.velocity[axis]) : 1;
}

bool ModeGuard::tip_too_fast(bool off_path) const noexcept {
  if (mode_ != OperatingMode::Manual || !robot_.states.powered() || robot_.states.is(GroupState::Homing)) {
    return false;
  }
  TipSpeed tip(robot_.tool.arm());
  tip.begin(robot_.axes.passed());
  tip.note(robot_.commanded());
  // The path on which a belt carries the arm was not planned, so axes may move against each other.
  return (off_path ? tip.farthest() : tip.moved()) > kReducedSpeed * robot_.period;
}

ErrorCode ModeGuard::axis_permit() const noexcept {
  return robot_.states.powered() && !robot_.states.is(GroupState::Standby) ? ErrorCode::State : permit_;
}

}  // namespace indurop::robot
