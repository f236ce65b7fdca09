// SPDX-License-Identifier: Apache-2.0
// Motion of a single axis through a position, where it has the velocity that it continues with.

#include <algorithm>
#include <cmath>

#include "control/robot/axis/motion.h"

namespace indurop::robot {

namespace {

// Returns the tolerance of a distance, above rounding.
double slack(double length) noexcept {
  return 1e-12 + 1e-9 * std::abs(length);
}

}  // namespace

void AxisMotion::move_through(double position, double velocity, const LineLimits& limits,
                              const LineLimits& braking) noexcept {
  goal_ = Goal::Through;
  target_ = position;
  end_velocity_ = velocity;
  limits_ = limits;
  braking_ = braking;
  on_last_way_ = false;
  went_through_.reset();
  plan();
}

bool AxisMotion::went_through(double position) const noexcept {
  return went_through_ && std::abs(*went_through_ - position) <= slack(position);
}

void AxisMotion::go_on_with(double velocity, const LineLimits& limits, const LineLimits& braking) noexcept {
  const std::optional<double> place = went_through_;
  move_with(velocity, std::abs(velocity) < std::abs(state_.velocity) ? braking : limits);
  went_through_ = place;
}

// Computed in the direction in which the axis passes the position. An axis that gets there without turning back, and
// has enough room for the velocity, goes straight there.
std::optional<double> AxisMotion::rests_first(const LineState& from, double position, double velocity,
                                              const LineLimits& limits, const LineLimits& braking) noexcept {
  const double sign = velocity < 0 ? -1 : 1;
  const double speed = std::abs(velocity);
  const double length = sign * (position - from.position);
  const LineState ahead{0, sign * from.velocity, sign * from.acceleration};
  const bool turns = ahead.velocity < 0 || unloaded(ahead, limits) < 0;
  if (!turns && speed > 0 && ramp(ahead, speed, limits, braking).distance <= length + slack(length)) {
    return std::nullopt;
  }
  const double before = length - ramp({0, 0, 0}, speed, limits).distance;
  const double rest = ramp(ahead, 0, braking).distance;
  return from.position + sign * (ahead.velocity < 0 && speed > 0 ? std::min(before, rest) : before);
}

void AxisMotion::plan_through() noexcept {
  const double velocity = override_ * end_velocity_;
  LineLimits limits = limits_;
  limits.velocity *= override_;
  const auto rest = rests_first(state_, target_, velocity, limits, braking_);
  if (!rest && plan_pass(velocity < 0 ? -1 : 1, std::abs(velocity))) {
    return;
  }
  if (on_last_way_) {
    go_behind();  // an override has left no room for it
    plan_wanted();
    return;
  }
  profile_ = Profile::to_rest(state_, rest.value_or(state_.position), limits, braking_);
}

// The axis is where it begins its final approach, or at the position.
void AxisMotion::step_through() noexcept {
  const double end = profile_.duration() + (passing_ ? faster_.duration() : 0);
  const double left = time_ - end;
  if (left < 0) {
    state_ = on_profile(time_);
    return;
  }
  state_ = on_profile(end);
  if (passing_ || end_velocity_ == 0) {
    state_.position = target_;
    go_behind();
  }
  plan();
  time_ = left;
  state_ = on_profile(left);
}

// From here on it continues with the velocity.
void AxisMotion::go_behind() noexcept {
  went_through_ = target_;
  goal_ = Goal::Velocity;
  target_ = end_velocity_;
  limits_.velocity = std::max(limits_.velocity, std::abs(end_velocity_));
  if (std::abs(override_ * end_velocity_) < std::abs(state_.velocity)) {
    limits_.acceleration = braking_.acceleration;
  }
}

}  // namespace indurop::robot
