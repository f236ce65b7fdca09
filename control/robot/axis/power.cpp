// SPDX-License-Identifier: Apache-2.0
// Power and reset of an axis. A command may hold the power as long as it has its Execute (MC_Power): it requests power
// again whenever it is lost, and waits while the axis is in ErrorStop.

#include <utility>

#include "control/robot/axis/control.h"

namespace indurop::robot {

namespace {

constexpr double kPowerTime = 3;    // s a drive may take to switch on or to leave a fault
constexpr int kHolds = 1;           // option of a command: holds power as long as it has its Execute
constexpr double kLetGoTime = 0.5;  // s to wait for switching off; a drive that stays on is used

}  // namespace

void AxisControl::administer(int ticket, const Command& command) noexcept {
  const AxisService service = service_of(command);
  const bool failed = state_ == AxisState::ErrorStop || drive_.faulty();
  if (service == AxisService::Reset && admin_.service == AxisService::PowerOff) {
    Owner owner{ticket, service};  // a reset does not cancel switching off
    finish(owner, failed ? ErrorCode::State : ErrorCode::Ok);
    return;
  }
  interrupt_power();
  if (service != AxisService::Reset && power_ != kNobody) {
    table_->end(std::exchange(power_, kNobody), ErrorCode::Aborted);
  }
  if (ticket != kRequest) {
    table_->active(ticket);
  }
  switch (service) {
    case AxisService::PowerOn:
      power_ = ticket != kRequest && command.option == kHolds ? ticket : kNobody;
      if (state_ != AxisState::ErrorStop) {
        take_power(ticket);
      } else if (power_ == kNobody) {
        Owner owner{ticket, service};
        finish(owner, ErrorCode::State);
      }
      break;
    case AxisService::PowerOff:
      give_power(ticket);
      break;
    default:
      admin_ = {ticket, service};
      waited_ = 0;
      if (emergency_) {
        finish(admin_, ErrorCode::Emergency);
      } else if (!failed && !group_stops_) {
        finish(admin_, ErrorCode::Ok);  // there is nothing to reset, and will not be when the group rests
      }
  }
}

// A later request ends the one in progress; a command that holds power continues afterwards.
void AxisControl::interrupt_power() noexcept {
  if (admin_.ticket == power_) {
    admin_ = {};
  } else {
    finish(admin_, ErrorCode::Aborted);
  }
}

void AxisControl::take_power(int ticket) noexcept {
  admin_ = {ticket, AxisService::PowerOn};
  waited_ = 0;
  letting_go_ = drive_.enabled() && !want_power_;
  want_power_ = !letting_go_;
}

// Switches power off at rest; until then the axis brakes.
void AxisControl::give_power(int ticket) noexcept {
  admin_ = {ticket, AxisService::PowerOff};
  release_stop();
  halt();
}

void AxisControl::keep_power() noexcept {
  if (power_falls()) {
    interrupt_power();
    give_power(std::exchange(power_, kNobody));
  } else if (power_ != kNobody && admin_.ticket == kNobody && !want_power_ && state_ != AxisState::ErrorStop) {
    take_power(power_);
  }
}

void AxisControl::wait_for_power(double seconds) noexcept {
  waited_ += seconds;
  if (letting_go_) {
    letting_go_ = drive_.enabled() && waited_ <= kLetGoTime;
    want_power_ = !letting_go_;
  } else if (drive_.enabled()) {
    finish(admin_, ErrorCode::Ok);
  } else if (waited_ > kPowerTime) {
    want_power_ = false;
    finish(admin_, drive_.faulty() ? ErrorCode::Drive : ErrorCode::Power);
  }
}

// PLCopen: an axis that is still braking is not reset.
void AxisControl::wait_for_reset(double seconds) noexcept {
  if (emergency_) {
    finish(admin_, ErrorCode::Emergency);
    return;
  }
  if (!motion_.at_rest() || group_stops_) {
    return;
  }
  if (state_ == AxisState::ErrorStop || drive_.faulty()) {
    reset();
  }
  waited_ += seconds;
  if (!drive_.faulty() || waited_ > kPowerTime) {
    finish(admin_, drive_.faulty() ? ErrorCode::Drive : ErrorCode::Ok);
  }
}

void AxisControl::reset() noexcept {
  drive_.reset();
  // Power returns on request only.
  want_power_ = want_power_ && drive_.enabled() && !quick_stopped_;
  if (state_ == AxisState::ErrorStop) {
    report_.error = ErrorCode::Ok;
  }
  if (state_ == AxisState::ErrorStop || in_group()) {
    state_ = drive_.enabled() && !quick_stopped_ ? AxisState::Standstill : AxisState::Disabled;
  }
}

}  // namespace indurop::robot
