// SPDX-License-Identifier: Apache-2.0
// One axis in its drive's cyclic torque mode (CiA 402: 10): what torque the drive is told, beside what the arm needs to
// hold itself, so that the axis pushes with what was asked for, and where nothing is in its way goes no faster than it
// may. It knows neither positions nor drives.

#pragma once

#include <array>
#include <limits>

namespace indurop::robot {

class TorqueControl {
 public:
  // N m, N m/s, rad/s, rad/s^2; N and m of an axis that slides. The torque has a sign, velocity and acceleration are
  // above 0. The ramp is the most: it is slower where what stands in the way and gives way would
  // make the axis too fast. 0: as quickly as that allows.
  struct Wish {
    double torque = 0;
    double ramp = 0;
    double velocity = 1;
    double acceleration = 1;
  };
  // What it moves: kg m2 (kg), and between which torques the axis has to stay beside what the arm needs.
  struct Load {
    double inertia = 1;
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
  };
  enum class Phase {
    Off,
    Resting,   // the axis comes to rest first
    Entering,  // the drive is told to change its mode
    Pushing    // the drive has
  };

  // From now on, also in place of another wish. Real-time safe, as all here.
  void take(const Wish& wish) noexcept;
  void off() noexcept;
  // The axis rests; the drive is told to change its mode.
  void enter() noexcept;
  // The drive is `late` periods away; more than kMostLate, it takes to change its mode.
  void push(int late) noexcept;
  void carry(const Load& load) noexcept { load_ = load; }
  // Part of the wish's velocity, from 0 to 1. 0: it lets go of what it pushes against, as quickly as it may.
  void set_override(double part) noexcept { override_ = part; }

  // The next period, while it pushes. `speed`: of the axis, as it was measured.
  void step(double speed, double period) noexcept;

  [[nodiscard]] Phase phase() const noexcept { return phase_; }
  [[nodiscard]] bool on() const noexcept { return phase_ != Phase::Off; }
  [[nodiscard]] bool pushes() const noexcept { return phase_ == Phase::Pushing; }
  [[nodiscard]] const Wish& wish() const noexcept { return wish_; }
  [[nodiscard]] const Load& load() const noexcept { return load_; }
  // Periods from a change of what the drive is told to when it is seen.
  [[nodiscard]] int late() const noexcept { return late_; }
  // For the drive, without what the arm needs.
  [[nodiscard]] double torque() const noexcept { return told_; }
  // It pushes with all of what was asked for.
  [[nodiscard]] bool reached() const noexcept { return reached_; }

 private:
  static constexpr int kMostLate = 6;

  [[nodiscard]] double ramp(double smooth, double period) const noexcept;

  Phase phase_ = Phase::Off;
  Wish wish_;
  Load load_;
  int late_ = 1;
  double override_ = 1;
  double asked_ = 0;    // on its ramp
  double carried_ = 0;  // what is in its way, as it seems
  double told_ = 0;
  std::array<double, kMostLate + 1> given_{};  // the last ones
  double speed_ = 0;
  bool reached_ = false;
};

}  // namespace indurop::robot
