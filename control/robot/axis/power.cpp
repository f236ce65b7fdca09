// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/power.h"

#include "control/robot/axis/service.h"

namespace indurop::robot {

namespace {

constexpr double kPowerTime = 3;       // s a drive may take to switch on or to leave a fault
constexpr int kHolds = 1;              // option of a command: holds power as long as it has its Execute
constexpr double kPowerOffTime = 0.5;  // s to wait for switching off; a drive that stays on is used

}  // namespace

bool AxisPower::take(int ticket, const Command& command) noexcept {
  const AxisService service = axis_service_of(command);
  const bool failed = parts_.state == AxisState::ErrorStop || parts_.drive.faulty();
  if (service == AxisService::Reset && owner_.service == AxisService::PowerOff) {
    // A reset does not cancel switching off.
    answers_.answer(ticket, service, failed ? ErrorCode::State : ErrorCode::Ok);
    return false;
  }
  interrupt();
  if (service != AxisService::Reset && answers_.has_holder()) {
    const int holder = answers_.holder();
    answers_.set_holder(AxisOwner::kNone);
    answers_.table().end(holder, ErrorCode::Aborted);
  }
  answers_.active(ticket);
  if (service == AxisService::PowerOff) {
    owner_ = {ticket, AxisService::PowerOff};
    return true;
  }
  if (service != AxisService::PowerOn) {
    take_reset(ticket, failed);
    return false;
  }
  answers_.set_holder(ticket != AxisOwner::kRequest && command.option == kHolds ? ticket : AxisOwner::kNone);
  if (parts_.state != AxisState::ErrorStop) {
    switch_on(ticket);
  } else if (!answers_.has_holder()) {
    answers_.answer(ticket, service, ErrorCode::State);
  }
  return false;
}

void AxisPower::take_reset(int ticket, bool failed) noexcept {
  owner_ = {ticket, AxisService::Reset};
  waited_ = 0;
  if (emergency_) {
    answers_.finish(owner_, ErrorCode::Emergency);
  } else if (!failed && !group_stops_) {
    answers_.finish(owner_, ErrorCode::Ok);  // there is nothing to reset, and will not be when the group rests
  }
}

// A later request ends the one in progress; a command that holds power continues afterwards.
void AxisPower::interrupt() noexcept {
  if (owner_.ticket == answers_.holder()) {
    owner_ = {};
  } else {
    answers_.finish(owner_, ErrorCode::Aborted);
  }
}

void AxisPower::switch_on(int ticket) noexcept {
  owner_ = {ticket, AxisService::PowerOn};
  waited_ = 0;
  switching_off_ = parts_.drive.enabled() && !wanted_;
  wanted_ = !switching_off_;
}

bool AxisPower::keep() noexcept {
  if (falls()) {
    interrupt();
    owner_ = {answers_.holder(), AxisService::PowerOff};
    answers_.set_holder(AxisOwner::kNone);
    return true;
  }
  if (answers_.has_holder() && !owner_.any() && !wanted_ && parts_.state != AxisState::ErrorStop) {
    switch_on(answers_.holder());
  }
  return false;
}

void AxisPower::wait_for_power(double seconds) noexcept {
  if (owner_.service != AxisService::PowerOn) {
    return;
  }
  waited_ += seconds;
  if (switching_off_) {
    switching_off_ = parts_.drive.enabled() && waited_ <= kPowerOffTime;
    wanted_ = !switching_off_;
  } else if (parts_.drive.enabled()) {
    answers_.finish(owner_, ErrorCode::Ok);
  } else if (waited_ > kPowerTime) {
    wanted_ = false;
    answers_.finish(owner_, parts_.drive.faulty() ? ErrorCode::Drive : ErrorCode::Power);
  }
}

void AxisPower::step(double seconds) noexcept {
  if (owner_.service == AxisService::PowerOff && parts_.motion.at_rest()) {
    wanted_ = false;
    if (!parts_.drive.enabled()) {
      answers_.finish(owner_, ErrorCode::Ok);
    }
  }
  if (owner_.service == AxisService::Reset) {
    wait_for_reset(seconds);
  }
}

// PLCopen: an axis that is still braking is not reset.
void AxisPower::wait_for_reset(double seconds) noexcept {
  if (emergency_) {
    answers_.finish(owner_, ErrorCode::Emergency);
    return;
  }
  if (!parts_.motion.at_rest() || group_stops_) {
    return;
  }
  if (parts_.state == AxisState::ErrorStop || parts_.drive.faulty()) {
    reset();
  }
  waited_ += seconds;
  if (!parts_.drive.faulty() || waited_ > kPowerTime) {
    answers_.finish(owner_, parts_.drive.faulty() ? ErrorCode::Drive : ErrorCode::Ok);
  }
}

void AxisPower::reset() noexcept {
  parts_.drive.reset();
  // Power returns on request only.
  wanted_ = wanted_ && parts_.drive.enabled() && !quick_stopped_;
  if (parts_.state == AxisState::ErrorStop) {
    answers_.clear_error();
  }
  if (parts_.state == AxisState::ErrorStop || parts_.in_group()) {
    parts_.state = parts_.drive.enabled() && !quick_stopped_ ? AxisState::Standstill : AxisState::Disabled;
  }
}

void AxisPower::fail(ErrorCode code) noexcept {
  if (owner_.ticket == answers_.holder()) {
    owner_ = {};  // continues once it has been reset
  } else if (owner_.service != AxisService::Reset) {
    answers_.finish(owner_, code);
  }
}

void AxisPower::end_request() noexcept {
  if (owner_.is_request()) {
    answers_.finish(owner_, ErrorCode::Aborted);
  }
}

Drive::Want AxisPower::want_of_drive(bool quick_stop) noexcept {
  quick_stopped_ = quick_stop && parts_.state == AxisState::ErrorStop;
  if (quick_stopped_) {
    return Drive::Want::QuickStop;
  }
  return wanted_ ? Drive::Want::On : Drive::Want::Off;
}

}  // namespace indurop::robot
