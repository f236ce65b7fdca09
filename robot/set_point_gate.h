// SPDX-License-Identifier: Apache-2.0
// The last gate before the drive of one axis: no set point passes that breaks a limit, whoever made it. It looks at set
// points as the drive sees them, one per period, and knows nothing of paths. Once it has refused one it brakes by
// itself.

#pragma once

#include "robot/errors.h"
#include "robot/profile.h"

namespace indurop::robot {

class SetPointGate {
 public:
  struct Range {
    double lower = 0, upper = 0;  // rad
    bool endless = false;         // turns on and on; lower and upper do not count
  };
  SetPointGate() = default;
  SetPointGate(const Range& range, const LineLimits& limits, double period) noexcept
      : range_(range), limits_(limits), period_(period) {}

  // The axis stands here: its drive has no power, or has just found its place. Real-time safe, as all here.
  void stand(double position) noexcept;
  // The drive moves the axis by itself, which is here, and as fast; it brakes from here.
  void follow(double position, double velocity) noexcept;
  // Whether the drive may get this set point next: within position, speed, acceleration and jerk, and such that the
  // axis can still come to rest before its end. An axis that stands beyond its end may come back. `hardness` multiplies
  // the acceleration. Changes nothing. Errors: Value (no number), JointLimit, Speed, Acceleration, Jerk.
  [[nodiscard]] ErrorCode check(double position, double hardness) const noexcept;
  // It gets it. `hardness`: as it was checked with.
  void pass(double position, double hardness) noexcept;
  // The next set point on the shortest way to rest, as `hardness` allows.
  void brake(double hardness) noexcept;

  // The set point nearest to `wanted` that speed, acceleration and jerk allow next; `wanted` itself, if they do.
  [[nodiscard]] double nearest(double wanted) const noexcept;
  // The next set point on the shortest way to no acceleration.
  [[nodiscard]] LineState unloaded() const noexcept;
  // Whether it could still come to rest before its end from there.
  [[nodiscard]] bool can_rest(const LineState& from) const noexcept {
    return range_.endless || can_rest(from, limits_);
  }
  // No acceleration, but for rounding.
  [[nodiscard]] bool coasts() const noexcept;

  // The last set point, its speed and its acceleration, as differences between periods.
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
  // The acceleration, had it never changed faster than it may: what rounding adds comes and goes, what a wrong path
  // adds stays and grows.
  double steady_ = 0;
};

}  // namespace indurop::robot
