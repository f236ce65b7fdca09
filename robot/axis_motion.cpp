// SPDX-License-Identifier: Apache-2.0
#include "robot/axis_motion.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kStill = 1e-3;  // an override below is a hold

LineState mirrored(const LineState& state, double sign) noexcept {
  return {sign * state.position, sign * state.velocity, sign * state.acceleration};
}

}  // namespace

void AxisMotion::reset(const LineState& state) noexcept {
  state_ = state;
  profile_ = Profile::coast(state);
  goal_ = Goal::Rest;
  sign_ = 1;
  time_ = 0;
  and_then_ = false;
}

void AxisMotion::move_to(double position, const LineLimits& limits) noexcept {
  goal_ = Goal::Position;
  target_ = position;
  limits_ = limits;
  plan();
}

void AxisMotion::move_with(double velocity, const LineLimits& limits) noexcept {
  goal_ = Goal::Velocity;
  target_ = velocity;
  limits_ = limits;
  plan();
}

void AxisMotion::stop(const LineLimits& limits) noexcept {
  goal_ = Goal::Rest;
  limits_ = limits;
  plan();
}

void AxisMotion::set_override(double part) noexcept {
  part = part < kStill ? 0 : std::min(part, 1.0);
  if (part != override_) {
    override_ = part;
    if (goal_ != Goal::Rest) {
      plan();
    }
  }
}

bool AxisMotion::held() const noexcept {
  return goal_ != Goal::Rest && override_ == 0;
}

void AxisMotion::plan() noexcept {
  switch (goal_) {
    case Goal::Rest:
      plan_to_velocity(0);
      break;
    case Goal::Position:
      plan_to_position();
      break;
    case Goal::Velocity:
      plan_to_velocity(override_ * target_);
      break;
  }
}

void AxisMotion::plan_to_velocity(double velocity) noexcept {
  profile_ = Profile::to_velocity(state_, velocity, limits_);
  sign_ = 1;
  time_ = 0;
  and_then_ = false;
}

void AxisMotion::plan_to_position() noexcept {
  const double stopping = ramp(state_, 0, limits_).distance;
  const double left = target_ - state_.position;
  const bool forwards = state_.velocity == 0 || (left > 0) == (state_.velocity > 0);
  // What is too long by rounding is not: an override may change where it is braking already.
  const bool too_long = std::abs(stopping) > std::abs(left) * (1 + 1e-9) + 1e-12;
  if (held() || !forwards || too_long) {
    plan_to_velocity(0);
    and_then_ = !held();
    return;
  }
  LineLimits limits = limits_;
  limits.velocity *= override_;
  sign_ = left < 0 ? -1 : 1;
  profile_ = Profile::to_position(mirrored(state_, sign_), sign_ * target_, 0, limits);
  time_ = 0;
  and_then_ = false;
}

void AxisMotion::step(double seconds) noexcept {
  time_ += seconds;
  if (and_then_ && time_ >= profile_.duration()) {
    const double left = time_ - profile_.duration();
    state_ = mirrored(profile_.end(), sign_);
    state_.velocity = 0;
    plan_to_position();
    time_ = left;
  }
  state_ = mirrored(profile_.at(time_), sign_);
  if (goal_ == Goal::Position && done()) {
    goal_ = Goal::Rest;  // it is there
  }
}

}  // namespace indurop::robot
