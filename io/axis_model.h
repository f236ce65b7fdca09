// SPDX-License-Identifier: Apache-2.0
// A motor with its load, the drive's position and velocity loop around it, and the encoder on its shaft: a second-order
// system with limits, advanced in steps of fixed length so that equal commands give equal motion. Radians, seconds, N
// m. Real-time safe.

#pragma once

#include <cstdint>
#include <numbers>

#include "config/model/io_config.h"

namespace indurop::io {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

// What the loops are to follow at the end of one step.
struct AxisReference {
  double position = 0;
  double velocity = 0;
  bool follow_position = true;  // false: the velocity alone counts
  double torque = 0;            // on top of what the loops want
};

class AxisModel {
 public:
  static constexpr std::int64_t kStepNs = 125'000;
  static constexpr double kStep = 125e-6;  // the same in seconds

  explicit AxisModel(const config::IoAxis& axis) noexcept;

  // The mean of its torque since the last call, N m; without a step since, the last one.
  [[nodiscard]] double take_mean_torque() noexcept;
  // What the axis carries from now on, beside its own inertia and damping: torque against the motor.
  void carry(double load) noexcept { load_ = load; }
  // One step with the loops closed.
  void drive(const AxisReference& reference) noexcept;
  // One step with a torque alone; at the axis' largest velocity no more than keeps it.
  void push(double torque) noexcept;
  // One step without power: the brake holds what it carries, and stops it with the motor's largest torque.
  void brake() noexcept;

  [[nodiscard]] double position() const noexcept { return position_; }
  [[nodiscard]] double velocity() const noexcept { return velocity_; }
  [[nodiscard]] double torque() const noexcept { return torque_; }
  [[nodiscard]] bool limited() const noexcept { return limited_; }  // torque or velocity, in the last step
  [[nodiscard]] double most_velocity() const noexcept { return most_velocity_; }
  // What the motor can brake with.
  [[nodiscard]] double most_deceleration() const noexcept { return most_torque_ / inertia_; }

  // Encoder counts from power on at `start`, not yet wrapped to a register's size. Each call may see other noise.
  [[nodiscard]] std::int64_t read_encoder() noexcept;
  [[nodiscard]] double counts_per_radian() const noexcept { return counts_per_radian_; }

 private:
  void accelerate(double torque) noexcept;
  double noise() noexcept;

  double inertia_;
  double damping_;
  double most_torque_;
  double most_velocity_;
  double position_gain_;  // 1/s
  double velocity_gain_;  // 1/s
  double counts_per_radian_;
  double noise_counts_;
  std::uint64_t random_;
  double position_;
  double velocity_ = 0;
  double torque_ = 0;
  double load_ = 0;
  double torques_ = 0;  // sum of the steps since take_mean_torque()
  int steps_ = 0;
  bool limited_ = false;
};

}  // namespace indurop::io
