// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/power.h"

#include <algorithm>

namespace indurop::robot {

namespace {

constexpr double kPowerTime = 4;        // s within which all drives must have power or have left a fault
constexpr double kSwitchOffTime = 0.5;  // s to wait for drives to switch off; one that stays on is used as it is

}  // namespace

ErrorCode Power::enable() noexcept {
  if (robot_.states.emergency()) {
    return ErrorCode::Emergency;
  }
  if (robot_.states.is(GroupState::Standby)) {
    group_.finish_service(ErrorCode::Ok);
    return ErrorCode::Ok;
  }
  if (!robot_.states.is(GroupState::Disabled)) {
    return ErrorCode::State;
  }
  enabling_ = true;
  quick_stop_ = false;
  waited_ = 0;
  // A drive that was commanded to switch off reports it later: its present status is ignored.
  switching_off_ = any_switches_off();
  if (!switching_off_) {
    robot_.axes.power(true);
  }
  return ErrorCode::Ok;
}

bool Power::any_switches_off() const noexcept {
  return std::any_of(robot_.axes.begin(), robot_.axes.end(),
                     [](const AxisControl& a) { return a.drive().enabled() && !a.wants_power(); });
}

void Power::run_enabling() noexcept {
  if (!enabling_) {
    return;
  }
  waited_ += robot_.period;
  if (switching_off_) {
    switching_off_ = any_switches_off() && waited_ <= kSwitchOffTime;
    if (!switching_off_) {
      robot_.axes.power(true);
    }
  } else if (robot_.axes.all_enabled()) {
    enabling_ = false;
    group_.come_to_standby();
    group_.finish_service(ErrorCode::Ok);
  } else if (waited_ > kPowerTime) {
    fail_enabling();
  }
}

void Power::fail_enabling() noexcept {
  enabling_ = false;
  int late = 0;
  while (late < robot_.count() - 1 && robot_.axes[late].drive().enabled()) {
    ++late;
  }
  robot_.axes.power(false);
  group_.finish_service(Fault{robot_.axes[late].drive().faulty() ? ErrorCode::Drive : ErrorCode::Power, late + 1});
}

// Acknowledges the fault of one drive after another. Returns false while one of them still has its fault; if that takes
// too long, the service ends.
bool Power::clear_faults() noexcept {
  for (int i = 0; i < robot_.count(); ++i) {
    AxisControl& a = robot_.axes[i];
    if (a.drive().faulty()) {
      a.reset();
      if (waited_ > kPowerTime) {
        group_.finish_service(Fault{ErrorCode::Drive, i + 1});
      }
      return false;
    }
  }
  // An axis that has not reached its set point yet would trip again.
  if (const int behind = robot_.axes.first_behind(); behind >= 0) {
    if (waited_ > kPowerTime) {
      group_.finish_service(Fault{ErrorCode::Following, behind + 1});
    }
    return false;
  }
  return true;
}

ErrorCode Power::begin_reset() noexcept {
  waited_ = 0;
  return reset();
}

ErrorCode Power::reset() noexcept {
  GroupStates& states = robot_.states;
  if (states.to_error()) {
    // PLCopen: reset only at standstill.
    return states.emergency() ? ErrorCode::Emergency : ErrorCode::Ok;
  }
  const bool faulty =
      std::any_of(robot_.axes.begin(), robot_.axes.end(), [](const AxisControl& a) { return a.drive().faulty(); });
  if (!states.is(GroupState::ErrorStop) && !faulty) {
    if (enabling_ && !switching_off_) {
      robot_.axes.power(true);
    }
    group_.finish_service(ErrorCode::Ok);
    return ErrorCode::Ok;
  }
  if (states.emergency()) {
    return ErrorCode::Emergency;
  }
  waited_ += robot_.period;
  if (!clear_faults() || !states.is(GroupState::ErrorStop)) {
    return ErrorCode::Ok;
  }
  // A drive that is stopped in an emergency is about to lose its power, whatever it reports now.
  const bool has_power = states.error() != ErrorCode::Emergency && robot_.axes.all_enabled();
  quick_stop_ = false;
  torques_.release();
  for (AxisControl& a : robot_.axes) {
    a.reset();
  }
  states.disable();
  if (has_power) {
    group_.come_to_standby();
  } else {
    robot_.axes.give_up_power();
  }
  group_.finish_service(ErrorCode::Ok);
  return ErrorCode::Ok;
}

}  // namespace indurop::robot
