// SPDX-License-Identifier: Apache-2.0
// The master's side of one CiA 402 drive: brings it to the requested state by its control word, one transition per
// period, and evaluates its status word.

#pragma once

#include <indurop/robot/controller.h>

namespace indurop::robot {

class Drive {
 public:
  enum class State {
    NotReady,
    SwitchOnDisabled,
    ReadyToSwitchOn,
    SwitchedOn,
    OperationEnabled,
    QuickStop,
    FaultReaction,
    Fault
  };
  enum class Want { Off, On, QuickStop };

  static constexpr std::int8_t kCyclicTorque = 10;  // mode of operation

  static State state_of(std::uint16_t status) noexcept;

  // Takes the drive's status and determines its control word and mode. Real-time safe.
  void step(const DriveIn& in, Want want) noexcept;
  // Acknowledges the drive's fault until the drive has left it.
  void reset() noexcept { resetting_ = true; }
  // Homes with the drive's own method while `on`.
  void home(bool on) noexcept { homing_ = on; }
  // Commands torques instead of positions while `on`.
  void torque(bool on) noexcept { torque_ = on; }

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] bool enabled() const noexcept { return state_ == State::OperationEnabled; }
  [[nodiscard]] bool faulty() const noexcept { return state_ == State::Fault || state_ == State::FaultReaction; }
  [[nodiscard]] bool home_found() const noexcept { return home_found_; }
  [[nodiscard]] bool home_failed() const noexcept { return home_failed_; }
  [[nodiscard]] std::uint16_t control() const noexcept { return control_; }
  [[nodiscard]] std::int8_t mode() const noexcept { return mode_; }

 private:
  State state_ = State::NotReady;
  bool resetting_ = false;
  bool homing_ = false;
  bool torque_ = false;
  bool home_found_ = false;
  bool home_failed_ = false;
  std::uint16_t control_ = 0;
  std::int8_t mode_ = 0;
};

}  // namespace indurop::robot
