// SPDX-License-Identifier: Apache-2.0
#include "robot/axis_motion.h"

#include <cmath>

namespace indurop::robot {

namespace {

LineState mirrored(const LineState& state, double sign) noexcept {
  return {sign * state.position, sign * state.velocity, sign * state.acceleration};
}

}  // namespace

void AxisMotion::reset(const LineState& state) noexcept {
  state_ = state;
  profile_ = Profile::coast(state);
  sign_ = 1;
  time_ = 0;
  and_then_ = false;
}

void AxisMotion::move_with(double velocity, const LineLimits& limits) noexcept {
  profile_ = Profile::to_velocity(state_, velocity, limits);
  sign_ = 1;
  time_ = 0;
  and_then_ = false;
}

void AxisMotion::stop(const LineLimits& limits) noexcept {
  move_with(0, limits);
}

void AxisMotion::move_to(double position, const LineLimits& limits) noexcept {
  const double stopping = ramp(state_, 0, limits).distance;
  const double left = position - state_.position;
  const bool forwards = state_.velocity == 0 || (left > 0) == (state_.velocity > 0);
  if (!forwards || std::abs(stopping) > std::abs(left) * (1 + 1e-12)) {
    stop(limits);
    and_then_ = true;
    target_ = position;
    limits_ = limits;
    return;
  }
  sign_ = left < 0 ? -1 : 1;
  profile_ = Profile::to_position(mirrored(state_, sign_), sign_ * position, 0, limits);
  time_ = 0;
  and_then_ = false;
}

void AxisMotion::step(double seconds) noexcept {
  time_ += seconds;
  if (and_then_ && time_ >= profile_.duration()) {
    const double left = time_ - profile_.duration();
    state_ = mirrored(profile_.end(), sign_);
    state_.velocity = 0;
    move_to(target_, limits_);
    time_ = left;
  }
  state_ = mirrored(profile_.at(time_), sign_);
}

}  // namespace indurop::robot
