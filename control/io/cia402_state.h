// SPDX-License-Identifier: Apache-2.0
// The state machine of a drive as defined by CiA 402 (IEC 61800-7-201): controlword in, state and statusword out. No
// motion, no time. Real-time safe.

#pragma once

#include <cstdint>

namespace indurop::io {

enum class DriveState : std::uint8_t {
  NotReady,
  SwitchOnDisabled,
  ReadyToSwitchOn,
  SwitchedOn,
  OperationEnabled,
  QuickStopActive,
  FaultReaction,
  Fault
};

// Bits of the controlword in addition to the commands.
inline constexpr std::uint16_t kNewSetPoint = 1U << 4U;  // homing: start
inline constexpr std::uint16_t kChangeAtOnce = 1U << 5U;
inline constexpr std::uint16_t kRelative = 1U << 6U;
inline constexpr std::uint16_t kFaultReset = 1U << 7U;
inline constexpr std::uint16_t kHalt = 1U << 8U;

// Bits of the statusword in addition to the state.
inline constexpr std::uint16_t kVoltage = 1U << 4U;
inline constexpr std::uint16_t kRemote = 1U << 9U;
inline constexpr std::uint16_t kTargetReached = 1U << 10U;
inline constexpr std::uint16_t kLimitActive = 1U << 11U;
inline constexpr std::uint16_t kModeBit12 = 1U << 12U;  // set-point acknowledge, speed 0, homed, follows
inline constexpr std::uint16_t kModeBit13 = 1U << 13U;  // following error, homing error

// Error codes.
inline constexpr std::uint16_t kFollowingError = 0x8611;

class DriveStateMachine {
 public:
  // At most one transition by command, and none after an automatic one. `standing`: the axis is at standstill, so ramps
  // have ended.
  void step(std::uint16_t control, bool standing) noexcept;
  // Enters the fault reaction. The first error stays until it is reset.
  void fail(std::uint16_t error) noexcept;

  [[nodiscard]] DriveState state() const noexcept { return state_; }
  [[nodiscard]] std::uint16_t error() const noexcept { return error_; }
  // Returns bits 0 to 3, 5 and 6 of the statusword.
  [[nodiscard]] std::uint16_t status() const noexcept;

 private:
  DriveState state_ = DriveState::NotReady;
  std::uint16_t error_ = 0;
  std::uint16_t last_control_ = 0;
};

}  // namespace indurop::io
