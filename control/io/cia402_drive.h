// SPDX-License-Identifier: Apache-2.0
// A simulated CiA 402 drive: the objects of a servo drive, with its state machine, its modes of operation and an axis.
// Computed in the tick, so the same commands give bit-identical motion. Real-time safe.

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "config/model/io_config.h"
#include "control/io/axis_model.h"
#include "control/io/axis_profile.h"
#include "control/io/cia402_homing.h"
#include "control/io/cia402_probe.h"
#include "control/io/cia402_state.h"

namespace indurop::io {

enum class DriveMode : std::int8_t {
  None = 0,
  ProfilePosition = 1,
  ProfileVelocity = 3,
  ProfileTorque = 4,
  Homing = 6,
  InterpolatedPosition = 7,
  CyclicPosition = 8,
  CyclicVelocity = 9,
  CyclicTorque = 10
};

// Return the kind of set point that a mode commands.
constexpr bool is_position(DriveMode mode) noexcept {
  return mode == DriveMode::None || mode == DriveMode::ProfilePosition || mode == DriveMode::InterpolatedPosition ||
         mode == DriveMode::CyclicPosition;
}
constexpr bool is_torque(DriveMode mode) noexcept {
  return mode == DriveMode::ProfileTorque || mode == DriveMode::CyclicTorque;
}
constexpr bool is_cyclic(DriveMode mode) noexcept {
  return mode == DriveMode::CyclicPosition || mode == DriveMode::CyclicVelocity || mode == DriveMode::CyclicTorque;
}

struct DriveCommand {
  std::uint16_t control = 0;
  std::int8_t mode = 0;
  std::int32_t position = 0;  // target, counts
  std::int32_t velocity = 0;  // target, counts / s
  std::int16_t torque = 0;    // target, 1/1000 of the motor's maximum
  // Offsets that cyclic modes add to the targets.
  std::int32_t position_offset = 0;
  std::int32_t velocity_offset = 0;
  std::int16_t torque_offset = 0;
  std::uint16_t probe = 0;  // function of the touch probes (0x60B8)
  double load = 0;          // not an object of a drive: load on the axis, N m
};

struct DriveFeedback {
  std::uint16_t error = 0;
  std::uint16_t status = 0;
  std::int8_t mode = 0;
  std::int32_t position = 0;    // counts, wraps around like the register of a real drive
  std::int32_t velocity = 0;    // counts / s
  std::int16_t torque = 0;      // mean of the period, 1/1000 of the motor's maximum
  std::int32_t following = 0;   // following error, counts
  std::uint32_t inputs = 0;     // digital inputs (0x60FD): limit switches, home switch, probes
  std::uint16_t probe = 0;      // status of the touch probes (0x60B9)
  std::int32_t probe_rise = 0;  // stored positions, counts
  std::int32_t probe_fall = 0;
  std::int32_t probe2_rise = 0;
  std::int32_t probe2_fall = 0;
};

class Cia402Drive {
 public:
  explicit Cia402Drive(const config::IoAxis& axis) noexcept;
  Cia402Drive(const Cia402Drive&) = delete;
  Cia402Drive& operator=(const Cia402Drive&) = delete;
  ~Cia402Drive() = default;

  // Simulates the next period: applies the command at its beginning, returns the drive's feedback at its end.
  DriveFeedback step(const DriveCommand& command, std::chrono::nanoseconds elapsed) noexcept;

  [[nodiscard]] DriveState state() const noexcept { return machine_.state(); }

 private:
  void take_mode(std::int8_t mode) noexcept;
  void take_set_point(const DriveCommand& command) noexcept;
  void follow_actual() noexcept;  // set points continue from the actual position
  void start_over() noexcept;     // also discards all earlier commands
  void advance(const DriveCommand& command, double dt) noexcept;
  void advance_enabled(const DriveCommand& command, double dt) noexcept;
  void advance_homing(const DriveCommand& command, double dt) noexcept;
  void advance_torque(const DriveCommand& command, double dt) noexcept;
  void go_straight_home(double dt) noexcept;
  void stop_at_limits(const AxisProfile& before, double dt) noexcept;
  void close_loops(const DriveCommand& command) noexcept;
  [[nodiscard]] double cyclic_target(const DriveCommand& command) const noexcept;
  [[nodiscard]] double degrees() const noexcept;
  [[nodiscard]] std::int32_t shown(double degrees) const noexcept;
  void report_sensors(DriveFeedback& result) const noexcept;
  void advance_profile_position(const DriveCommand& command, double dt) noexcept;
  void watch_following(double dt) noexcept;
  [[nodiscard]] double radians_of(std::int32_t counts) const noexcept;
  [[nodiscard]] bool standing() const noexcept;
  [[nodiscard]] std::uint16_t mode_bits(const DriveCommand& command) const noexcept;
  [[nodiscard]] DriveFeedback feedback(const DriveCommand& command) noexcept;

  config::IoAxis axis_;
  AxisModel model_;
  DriveStateMachine machine_;
  AxisProfile profile_;  // the reference; positions in the units of the model
  DriveMode mode_ = DriveMode::None;
  std::uint16_t last_control_ = 0;
  bool was_enabled_ = false;
  bool follows_position_ = true;
  bool reached_ = false;
  double target_ = 0;
  std::optional<double> next_target_;
  Homing homing_;
  enum class Home { Idle, Moving, Done } home_ = Home::Idle;  // homing directly to the mark
  TouchProbe probe_;
  TouchProbe probe2_;
  double torque_ = 0;             // demanded, N m
  bool at_limit_ = false;         // a limit switch stops the motion
  double last_;                   // position after the last step of the model
  double previous_;               // position after the step before
  std::int64_t zero_counts_ = 0;  // encoder counts that are reported as position 0
  double cyclic_velocity_ = 0;    // velocity towards the target of this period
  double following_error_s_ = 0;  // time with an excessive following error
  std::int64_t last_counts_;
};

}  // namespace indurop::io
