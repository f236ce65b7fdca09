// SPDX-License-Identifier: Apache-2.0
// The last check before the drive of one axis: no set point passes that violates a limit, whatever produced it. It sees
// set points as the drive does, one per period, and does not know paths. After it has rejected one it brakes on its
// own.

#pragma once

#include <cmath>

#include "control/robot/kinematics/errors.h"
#include "control/robot/path/profile.h"

namespace indurop::robot {

class SetPointGate {
 public:
  struct Range {
    double lower = -HUGE_VAL, upper = HUGE_VAL;  // rad
  };
  SetPointGate() = default;
  SetPointGate(const Range& range, const LineLimits& limits, double period) noexcept
      : range_(range), limits_(limits), period_(period) {}

  // The axis is at rest at `position`: its drive has no power, or has just been referenced. Real-time safe, like all
  // functions of this class.
  void stand(double position) noexcept;
  // The drive moves the axis on its own, with this position and velocity; braking starts from there.
  void follow(double position, double velocity) noexcept;
  // Checks whether the drive may get this set point next: within position, speed, acceleration and jerk, and such that
  // the axis can still come to rest before its limit. An axis beyond its limit may return. `hardness` multiplies the
  // acceleration. Changes nothing. Errors: Value (not a number), JointLimit, Speed, Acceleration, Jerk.
  [[nodiscard]] ErrorCode check(double position, double hardness) const noexcept;
  // Records that the drive gets this set point. `hardness`: the one it was checked with.
  void pass(double position, double hardness) noexcept;
  // Computes the next set point of the shortest way to rest with this `hardness`.
  void brake(double hardness) noexcept;

  // The set point nearest to `wanted` that speed, acceleration and jerk allow next; `wanted` itself if they allow it.
  [[nodiscard]] double nearest(double wanted) const noexcept;
  // The set point that brake(1) leads to.
  [[nodiscard]] LineState braked() const noexcept { return braked(state_, limits_); }
  // The next set point of the shortest way to zero acceleration.
  [[nodiscard]] LineState unloaded() const noexcept;
  // Returns whether the axis could still come to rest before its limit from that state.
  [[nodiscard]] bool can_rest(const LineState& from) const noexcept { return can_rest(from, limits_); }
  // Returns whether the acceleration is zero, except for rounding.
  [[nodiscard]] bool coasts() const noexcept;

  // The last set point, its speed and its acceleration, computed as differences between periods.
  [[nodiscard]] const LineState& state() const noexcept { return state_; }
  [[nodiscard]] bool at_rest() const noexcept { return state_.velocity == 0 && state_.acceleration == 0; }

 private:
  [[nodiscard]] LineState after(double position) const noexcept;
  [[nodiscard]] LineLimits harder(double hardness) const noexcept;
  [[nodiscard]] double most_step(double hardness) const noexcept;
  [[nodiscard]] LineState braked(LineState state, const LineLimits& limits) const noexcept;
  [[nodiscard]] bool may_be(double position) const noexcept;
  [[nodiscard]] bool can_rest(LineState state, const LineLimits& limits) const noexcept;

  Range range_;
  LineLimits limits_;
  double period_ = 0.01;  // s
  LineState state_;
  // The acceleration as if it had never changed faster than allowed: differences caused by rounding come and go, those
  // caused by a wrong path stay and grow.
  double steady_ = 0;
};

}  // namespace indurop::robot
