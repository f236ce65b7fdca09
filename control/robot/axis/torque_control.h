// SPDX-License-Identifier: Apache-2.0
// Controls one axis in its drive's cyclic torque mode (CiA 402: 10): computes the torque set point, in addition to the
// torque that the arm needs to hold itself, so that the axis pushes with the requested torque, and, if nothing is in
// its way, does not exceed its speed limit. It knows neither positions nor drives.

#pragma once

#include <array>
#include <limits>

namespace indurop::robot {

class TorqueControl {
 public:
  // N m, N m/s, rad/s, rad/s^2; N and m for an axis that slides. The torque has a sign, velocity and acceleration are
  // above 0. The ramp is a maximum: it is slower if an obstacle that gives way would make the axis too fast. 0: as fast
  // as that allows.
  struct Request {
    double torque = 0;
    double ramp = 0;
    double velocity = 1;
    double acceleration = 1;
  };
  // The moved inertia: kg m2 (kg); and the limits of the axis torque in addition to what the arm needs.
  struct Load {
    double inertia = 1;
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
  };
  enum class Phase {
    Off,
    Resting,   // the axis comes to rest first
    Entering,  // the drive is commanded to change its mode
    Pushing    // the drive has changed its mode
  };

  // Starts with this request, or replaces an earlier one. Real-time safe, like all functions of this class.
  void take(const Request& request) noexcept;
  void off() noexcept;
  // The axis is at rest; the drive is commanded to change its mode.
  void enter() noexcept;
  // The drive responds after `late` periods; if more than kMostLate, the drive needs them to change its mode.
  void push(int late) noexcept;
  void carry(const Load& load) noexcept { load_ = load; }
  // Part of the requested velocity, from 0 to 1. 0: it stops pushing, as fast as it may.
  void set_override(double part) noexcept { override_ = part; }

  // Computes the next period, while it pushes. `speed`: measured speed of the axis.
  void step(double speed, double period) noexcept;

  [[nodiscard]] Phase phase() const noexcept { return phase_; }
  [[nodiscard]] bool on() const noexcept { return phase_ != Phase::Off; }
  [[nodiscard]] bool pushes() const noexcept { return phase_ == Phase::Pushing; }
  [[nodiscard]] const Request& request() const noexcept { return request_; }
  [[nodiscard]] const Load& load() const noexcept { return load_; }
  // Periods from a change of the set point until its effect is measured.
  [[nodiscard]] int late() const noexcept { return late_; }
  // Torque set point, without what the arm needs.
  [[nodiscard]] double torque() const noexcept { return torque_; }
  // Returns whether it pushes with the full requested torque.
  [[nodiscard]] bool reached() const noexcept { return reached_; }

 private:
  static constexpr int kMostLate = 6;

  [[nodiscard]] double ramp(double smooth, double period) const noexcept;

  Phase phase_ = Phase::Off;
  Request request_;
  Load load_;
  int late_ = 1;
  double override_ = 1;
  double asked_ = 0;    // with its ramp
  double carried_ = 0;  // estimated torque of the obstacle
  double torque_ = 0;
  std::array<double, kMostLate + 1> given_{};  // the last ones
  double speed_ = 0;
  bool reached_ = false;
};

}  // namespace indurop::robot
