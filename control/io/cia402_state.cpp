// SPDX-License-Identifier: Apache-2.0
#include "control/io/cia402_state.h"

namespace indurop::io {
namespace {

enum class Command { DisableVoltage, QuickStop, Shutdown, SwitchOn, EnableOperation };

Command command_in(std::uint16_t control) noexcept {
  constexpr unsigned kSwitchOn = 1;
  constexpr unsigned kEnableVoltage = 2;
  constexpr unsigned kNoQuickStop = 4;
  constexpr unsigned kEnable = 8;
  if ((control & kEnableVoltage) == 0) {
    return Command::DisableVoltage;
  }
  if ((control & kNoQuickStop) == 0) {
    return Command::QuickStop;
  }
  if ((control & kSwitchOn) == 0) {
    return Command::Shutdown;
  }
  return (control & kEnable) == 0 ? Command::SwitchOn : Command::EnableOperation;
}

// Returns the state after a command; the same state where the standard has no transition.
DriveState after(DriveState state, Command command) noexcept {
  const bool off = command == Command::DisableVoltage;
  switch (state) {
    case DriveState::SwitchOnDisabled:
      return command == Command::Shutdown ? DriveState::ReadyToSwitchOn : state;
    case DriveState::ReadyToSwitchOn:
      if (off || command == Command::QuickStop) {
        return DriveState::SwitchOnDisabled;
      }
      return command == Command::Shutdown ? state : DriveState::SwitchedOn;
    case DriveState::SwitchedOn:
      if (off || command == Command::QuickStop) {
        return DriveState::SwitchOnDisabled;
      }
      return command == Command::Shutdown          ? DriveState::ReadyToSwitchOn
             : command == Command::EnableOperation ? DriveState::OperationEnabled
                                                   : state;
    case DriveState::OperationEnabled:
      if (off) {
        return DriveState::SwitchOnDisabled;
      }
      if (command == Command::QuickStop) {
        return DriveState::QuickStopActive;
      }
      if (command == Command::Shutdown) {
        return DriveState::ReadyToSwitchOn;
      }
      return command == Command::SwitchOn ? DriveState::SwitchedOn : state;
    case DriveState::QuickStopActive:
      return off ? DriveState::SwitchOnDisabled : state;
    case DriveState::NotReady:
    case DriveState::FaultReaction:
    case DriveState::Fault:
      break;
  }
  return state;
}

}  // namespace

void DriveStateMachine::step(std::uint16_t control, bool standing) noexcept {
  const bool reset = (control & kFaultReset) != 0 && (last_control_ & kFaultReset) == 0;
  last_control_ = control;
  switch (state_) {
    case DriveState::NotReady:
      state_ = DriveState::SwitchOnDisabled;
      return;
    case DriveState::FaultReaction:
      state_ = standing ? DriveState::Fault : state_;
      return;
    case DriveState::Fault:
      if (reset) {
        state_ = DriveState::SwitchOnDisabled;
        error_ = 0;
      }
      return;
    case DriveState::QuickStopActive:
      if (standing) {
        state_ = DriveState::SwitchOnDisabled;
        return;
      }
      break;
    case DriveState::SwitchOnDisabled:
    case DriveState::ReadyToSwitchOn:
    case DriveState::SwitchedOn:
    case DriveState::OperationEnabled:
      break;
  }
  state_ = after(state_, command_in(control));
}

void DriveStateMachine::fail(std::uint16_t error) noexcept {
  if (state_ == DriveState::FaultReaction || state_ == DriveState::Fault) {
    return;
  }
  error_ = error;
  state_ = DriveState::FaultReaction;
}

std::uint16_t DriveStateMachine::status() const noexcept {
  constexpr std::uint16_t kQuickStopBit = 0x20;  // 0 while a quick stop is active
  switch (state_) {
    case DriveState::NotReady:
      return 0x00;
    case DriveState::SwitchOnDisabled:
      return 0x40;
    case DriveState::ReadyToSwitchOn:
      return kQuickStopBit | 0x01;
    case DriveState::SwitchedOn:
      return kQuickStopBit | 0x03;
    case DriveState::OperationEnabled:
      return kQuickStopBit | 0x07;
    case DriveState::QuickStopActive:
      return 0x07;
    case DriveState::FaultReaction:
      return 0x0F;
    case DriveState::Fault:
      return 0x08;
  }
  return 0;
}

}  // namespace indurop::io
