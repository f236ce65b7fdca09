// SPDX-License-Identifier: Apache-2.0
// Motion of a single axis by itself: to a position, on and on with a velocity, to rest; each from whatever it is doing.
// An override slows it down at any moment, to rest at 0, and it goes on when that ends.

#pragma once

#include "robot/profile.h"

namespace indurop::robot {

class AxisMotion {
 public:
  // Moving on like this, with nothing to do. Real-time safe, as all here.
  void reset(const LineState& state) noexcept;
  // As fast as the limits allow, also where the way is too short or backwards.
  void move_to(double position, const LineLimits& limits) noexcept;
  void move_with(double velocity, const LineLimits& limits) noexcept;
  void stop(const LineLimits& limits) noexcept;
  // Part of the speed of motions, from 0 to 1; stops are not slowed down.
  void set_override(double part) noexcept;

  void step(double seconds) noexcept;

  [[nodiscard]] const LineState& state() const noexcept { return state_; }
  // Has come to the position, to the velocity, or to rest; not while an override of 0 holds it.
  [[nodiscard]] bool done() const noexcept { return !held() && time_ >= profile_.duration(); }
  [[nodiscard]] bool at_rest() const noexcept { return done() && state_.velocity == 0; }

 private:
  enum class Goal { Rest, Position, Velocity };

  [[nodiscard]] bool held() const noexcept;
  void plan() noexcept;

  Goal goal_ = Goal::Rest;
  double target_ = 0;  // position or velocity
  LineLimits limits_;
  double override_ = 1;
  Profile profile_;
  double time_ = 0;
  LineState state_;
};

}  // namespace indurop::robot
