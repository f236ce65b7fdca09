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

// From one velocity and acceleration to another velocity, there without acceleration: up to three phases.
struct Ramp {
  struct Phase {
    double duration = 0;
    double jerk = 0;
  };
  std::array<Phase, 3> phases{};
  double distance = 0;
  [[nodiscard]] double duration() const noexcept;
};

// Speed once the acceleration has been taken back to zero, as fast as the jerk allows. Real-time safe.
double unloaded(const LineState& from, const LineLimits& limits) noexcept;

// The fastest ramp. `from.position` does not count. Only acceleration and jerk of the limits do. Real-time safe, as
// everything here.
Ramp ramp(const LineState& from, double velocity, const LineLimits& limits) noexcept;
// The same to `velocity` >= 0: `braking` counts where it has to become slower.
Ramp ramp(const LineState& from, double velocity, const LineLimits& limits, const LineLimits& braking) noexcept;

class Profile {
 public:
  Profile() = default;

  // At rest, or moving on, as `state` says, for ever.
  static Profile coast(const LineState& state) noexcept;
  // As fast as possible to a velocity (not above the limit), which it then keeps.
  static Profile to_velocity(const LineState& from, double velocity, const LineLimits& limits) noexcept;
  // As fast as possible to `position`, not behind `from.position`, being there at the velocity `arrival` >= 0 (at the
  // limit, if that is lower) or, where the way is too short for that, as near to it as possible but never above
  // `arrival`. `from.velocity` is not negative. If the way is too short even for that, it comes to rest as soon as
  // possible behind `position`, and overshoots() says so.
  // `braking`: of its last ramp, where that is one down.
  static Profile to_position(const LineState& from, double position, double arrival, const LineLimits& limits,
                             const LineLimits& braking) noexcept;
  static Profile to_position(const LineState& from, double position, double arrival,
                             const LineLimits& limits) noexcept {
    return to_position(from, position, arrival, limits, limits);
  }

  // From any velocity and acceleration to rest at `position`, wherever that is, as fast as possible.
  static Profile to_rest(const LineState& from, double position, const LineLimits& limits,
                         const LineLimits& braking) noexcept;
  static Profile to_rest(const LineState& from, double position, const LineLimits& limits) noexcept {
    return to_rest(from, position, limits, limits);
  }
  // What to_rest() made with these limits, but in `duration` by not getting that fast; the same if it takes as long
  // anyway, or where nothing takes just that long.
  [[nodiscard]] Profile slower(const LineLimits& limits, double duration) const noexcept;

  // At `time` seconds after the start; beyond the end it moves on with its last velocity.
  [[nodiscard]] LineState at(double time) const noexcept;
  [[nodiscard]] double jerk_at(double time) const noexcept;
  [[nodiscard]] double duration() const noexcept { return duration_; }
  [[nodiscard]] bool overshoots() const noexcept { return overshoots_; }
  // Where it is at the end of its last phase.
  [[nodiscard]] const LineState& end() const noexcept { return end_; }
  // The greatest speed and acceleration on its way, in either direction; no position.
  [[nodiscard]] LineState peak() const noexcept;
  // The least and the greatest position on its way.
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
