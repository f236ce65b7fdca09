// SPDX-License-Identifier: Apache-2.0
// A simulated axis: a motor with its load, the drive's position and velocity loop, and the encoder on the shaft. A
// second-order system with limits, computed in steps so that equal commands give equal motion. The motor's torque
// follows at once, or with the lag of its winding. Units: rad, s, N m. Real-time safe.

#pragma once

#include <cstdint>
#include <numbers>

#include "config/model/io_config.h"

namespace indurop::io {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// The reference of the loops at the end of one step.
struct AxisReference {
  double position = 0;
  double velocity = 0;
  bool follow_position = true;  // false: only the velocity is controlled
  double torque = 0;            // added to the output of the loops, N m
};

class AxisModel {
 public:
  static constexpr std::int64_t kStepNs = 125'000;
  static constexpr double kStep = 125e-6;  // in seconds; the loops are made for this one

  explicit AxisModel(const config::IoAxis& axis) noexcept;

  // Sets the length of the next steps, s, more than 0 and at most kStep; kStep before.
  void set_step(double step) noexcept;
  // Returns the mean motor torque since the last call, N m; the last torque if there was no step since.
  [[nodiscard]] double take_mean_torque() noexcept;
  // Sets the load on the axis in addition to its own inertia and damping: a torque against the motor, N m.
  void carry(double load) noexcept { load_ = load; }
  // One step with closed loops.
  void drive(const AxisReference& reference) noexcept;
  // One step with torque control; at the axis' maximum velocity the torque is limited to what keeps it.
  void push(double torque) noexcept;
  // One step without power: the brake holds the load, and stops the axis with the motor's maximum torque.
  void brake() noexcept;

  [[nodiscard]] double position() const noexcept { return position_; }
  [[nodiscard]] double velocity() const noexcept { return velocity_; }
  [[nodiscard]] double torque() const noexcept { return torque_; }
  [[nodiscard]] bool limited() const noexcept { return limited_; }  // torque or velocity was limited in the last step
  [[nodiscard]] double max_velocity() const noexcept { return max_velocity_; }
  // Returns the maximum deceleration by the motor.
  [[nodiscard]] double max_deceleration() const noexcept { return max_torque_ / inertia_; }

  // Returns the encoder counts since power on at `start`, not yet wrapped to a register's size. The noise may differ
  // with each call.
  [[nodiscard]] std::int64_t read_encoder() noexcept;
  [[nodiscard]] double counts_per_radian() const noexcept { return counts_per_radian_; }

 private:
  void accelerate(double torque) noexcept;
  void move(double torque) noexcept;
  double noise() noexcept;

  double inertia_;
  double damping_;
  double max_torque_;
  double max_velocity_;
  double torque_rate_;    // 1/s, with which the torque follows the demanded one; 0: at once
  double position_gain_;  // 1/s
  double velocity_gain_;  // 1/s
  double counts_per_radian_;
  double noise_counts_;
  std::uint64_t random_;
  double position_;
  double velocity_ = 0;
  double torque_ = 0;
  double step_ = kStep;
  double lag_ = 0;  // what is left after a step of the difference between demanded torque and torque
  double load_ = 0;
  double torques_ = 0;  // sum of the steps since take_mean_torque()
  int steps_ = 0;
  bool limited_ = false;
};

}  // namespace indurop::io
