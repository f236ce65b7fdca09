// SPDX-License-Identifier: Apache-2.0
#include "robot/axis_motion.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kStill = 1e-3;  // an override below is a hold

}  // namespace

void AxisMotion::reset(const LineState& state) noexcept {
  state_ = state;
  profile_ = Profile::coast(state);
  goal_ = Goal::Rest;
  time_ = 0;
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
  time_ = 0;
  if (goal_ == Goal::Rest || held()) {
    profile_ = Profile::to_velocity(state_, 0, limits_);
  } else if (goal_ == Goal::Velocity) {
    profile_ = Profile::to_velocity(state_, override_ * target_, limits_);
  } else {
    profile_ = Profile::to_rest(state_, target_, {override_ * limits_.velocity, limits_.acceleration, limits_.jerk});
  }
}

void AxisMotion::step(double seconds) noexcept {
  time_ += seconds;
  state_ = profile_.at(time_);
  if (goal_ == Goal::Position && done()) {
    goal_ = Goal::Rest;  // it is there
  }
}

}  // namespace indurop::robot
