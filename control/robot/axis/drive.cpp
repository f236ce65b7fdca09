// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/drive.h"

namespace indurop::robot {

namespace {

// Control words of CiA 402.
constexpr std::uint16_t kDisableVoltage = 0x00;
constexpr std::uint16_t kQuickStop = 0x02;
constexpr std::uint16_t kShutdown = 0x06;
constexpr std::uint16_t kSwitchOn = 0x07;
constexpr std::uint16_t kEnable = 0x0F;
constexpr std::uint16_t kStartHoming = 0x10;
constexpr std::uint16_t kResetFault = 0x80;

// Modes of operation.
constexpr std::int8_t kHomingMode = 6;
constexpr std::int8_t kCyclicPosition = 8;

// Bits of the status word.
constexpr std::uint16_t kHomingAttained = 1U << 12;
constexpr std::uint16_t kHomingError = 1U << 13;

std::uint16_t towards_enabled(Drive::State state) noexcept {
  switch (state) {
    case Drive::State::SwitchOnDisabled:
      return kShutdown;
    case Drive::State::ReadyToSwitchOn:
      return kSwitchOn;
    case Drive::State::SwitchedOn:
    case Drive::State::OperationEnabled:
      return kEnable;
    case Drive::State::NotReady:
    case Drive::State::QuickStop:
    case Drive::State::FaultReaction:
    case Drive::State::Fault:
      break;
  }
  return kDisableVoltage;
}

}  // namespace

Drive::State Drive::state_of(std::uint16_t status) noexcept {
  switch (status & 0x4FU) {
    case 0x40:
      return State::SwitchOnDisabled;
    case 0x0F:
      return State::FaultReaction;
    case 0x08:
      return State::Fault;
    default:
      break;
  }
  switch (status & 0x6FU) {
    case 0x21:
      return State::ReadyToSwitchOn;
    case 0x23:
      return State::SwitchedOn;
    case 0x27:
      return State::OperationEnabled;
    case 0x07:
      return State::QuickStop;
    default:
      return State::NotReady;
  }
}

void Drive::step(const DriveIn& in, Want want) noexcept {
  state_ = state_of(in.status);
  const bool in_homing = homing_ && in.mode == kHomingMode && enabled();
  const bool started = (control_ & kStartHoming) != 0;
  home_found_ = in_homing && started && (in.status & kHomingAttained) != 0;
  home_failed_ = in_homing && started && (in.status & kHomingError) != 0;
  mode_ = homing_ ? kHomingMode : torque_ ? kCyclicTorque : kCyclicPosition;

  resetting_ = resetting_ && faulty();
  if (resetting_) {
    // The drive reacts to the rising edge.
    control_ = control_ == kResetFault ? kDisableVoltage : kResetFault;
    return;
  }
  switch (want) {
    case Want::Off:
      control_ = kDisableVoltage;
      return;
    case Want::QuickStop:
      control_ = state_ == State::OperationEnabled || state_ == State::QuickStop ? kQuickStop : kDisableVoltage;
      return;
    case Want::On:
      control_ = towards_enabled(state_);
      break;
  }
  if (in_homing) {
    control_ |= kStartHoming;
  }
}

}  // namespace indurop::robot
