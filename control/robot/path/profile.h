// SPDX-License-Identifier: Apache-2.0
// Jerk-limited motion along one line, as fast as its limits allow: seven phases of constant jerk, from any speed and
// acceleration. Pure arithmetic: a plan is made when something changes, and then only evaluated.

#pragma once

#include <array>
#include <utility>

namespace indurop::robot {

struct LineLimits {
  double velocity = 1;
  double acceleration = 1;
  double jerk = 1;
};

struct LineState {
  double position = 0;
  double velocity = 0;
  double acceleration = 0;
};

// A change from one velocity and acceleration to another velocity, with zero acceleration at its end: up to three
// phases.
struct Ramp {
  struct Phase {
    double duration = 0;
    double jerk = 0;
  };
  std::array<Phase, 3> phases{};
  double distance = 0;
  [[nodiscard]] double duration() const noexcept;
};

// Speed after the acceleration has been reduced to zero, as fast as the jerk allows. Real-time safe.
double unloaded(const LineState& from, const LineLimits& limits) noexcept;

// The fastest ramp. `from.position` is ignored, and only acceleration and jerk of the limits are used. Real-time safe,
// like all functions of this file.
Ramp ramp(const LineState& from, double velocity, const LineLimits& limits) noexcept;
// The same to `velocity` >= 0; `braking` applies where it has to become slower.
Ramp ramp(const LineState& from, double velocity, const LineLimits& limits, const LineLimits& braking) noexcept;

class Profile {
 public:
  Profile() = default;

  // At rest, or moving on with the velocity of `state`, without end.
  static Profile coast(const LineState& state) noexcept;
  // As fast as possible to a velocity (not above the limit), which it then keeps.
  static Profile to_velocity(const LineState& from, double velocity, const LineLimits& limits) noexcept;
  // As fast as possible to `position`, which is not before `from.position`, arriving at the velocity `arrival` >= 0 (at
  // the limit if that is lower) or, if the distance is too short for that, as close to it as possible but never above
  // `arrival`. `from.velocity` is not negative. If the distance is too short even for that, it comes to rest as soon as
  // possible after `position`, and overshoots() returns true.
  // `braking`: limits of its last ramp, if that slows down.
  static Profile to_position(const LineState& from, double position, double arrival, const LineLimits& limits,
                             const LineLimits& braking) noexcept;
  static Profile to_position(const LineState& from, double position, double arrival,
                             const LineLimits& limits) noexcept {
    return to_position(from, position, arrival, limits, limits);
  }

  // From any velocity and acceleration to rest at `position`, in either direction, as fast as possible.
  static Profile to_rest(const LineState& from, double position, const LineLimits& limits,
                         const LineLimits& braking) noexcept;
  static Profile to_rest(const LineState& from, double position, const LineLimits& limits) noexcept {
    return to_rest(from, position, limits, limits);
  }
  // The result of to_rest() with these limits, stretched to `duration` by a lower speed; unchanged if it takes that
  // long anyway, or if no speed gives exactly that duration.
  [[nodiscard]] Profile slower(const LineLimits& limits, double duration) const noexcept;

  // State at `time` seconds after the start; after the end it moves on with its last velocity.
  [[nodiscard]] LineState at(double time) const noexcept;
  [[nodiscard]] double jerk_at(double time) const noexcept;
  [[nodiscard]] double duration() const noexcept { return duration_; }
  [[nodiscard]] bool overshoots() const noexcept { return overshoots_; }
  // State at the end of its last phase.
  [[nodiscard]] const LineState& end() const noexcept { return end_; }
  // The greatest speed and acceleration of the motion, in either direction; the position is not set.
  [[nodiscard]] LineState peak() const noexcept;
  // The smallest and the greatest position of the motion.
  [[nodiscard]] std::pair<double, double> extent() const noexcept;

 private:
  void append(const Ramp& ramp) noexcept;
  void append(double duration, double jerk) noexcept;
  void append_way(double length, double last, const LineLimits& limits, const LineLimits& braking) noexcept;
  void mirror(double sign, const LineState& from, double position) noexcept;

  LineState start_;
  LineState end_;
  std::array<Ramp::Phase, 7> phases_{};
  int count_ = 0;
  double duration_ = 0;
  bool overshoots_ = false;
};

}  // namespace indurop::robot
