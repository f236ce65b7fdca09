// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/motion.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kStill = 1e-3;  // an override below this is a hold
constexpr double kMotionRounding = 1e-9;

}  // namespace

void AxisMotion::set_bounds(const LineLimits& most, double lower, double upper) noexcept {
  most_ = most;
  lower_ = lower;
  upper_ = upper;
}

void AxisMotion::reset(const LineState& state) noexcept {
  state_ = state;
  profile_ = Profile::coast(state);
  goal_ = Goal::Rest;
  passing_ = passed_ = harder_ = lent_ = false;
  went_through_.reset();
  time_ = 0;
}

void AxisMotion::lend(const LineState& state) noexcept {
  state_ = state;
  lent_ = true;
  passing_ = passed_ = harder_ = false;
}

void AxisMotion::go_on() noexcept {
  lent_ = false;
  plan();
}

void AxisMotion::move_to(double position, const LineLimits& limits, const LineLimits& braking) noexcept {
  goal_ = Goal::Position;
  target_ = position;
  limits_ = limits;
  braking_ = braking;
  arrival_ = 0;
  went_through_.reset();
  plan();
}

void AxisMotion::pass_with(double velocity) noexcept {
  if (goal_ == Goal::Position && velocity != arrival_) {
    arrival_ = velocity;
    plan();
  }
}

void AxisMotion::move_with(double velocity, const LineLimits& limits) noexcept {
  goal_ = Goal::Velocity;
  target_ = velocity;
  limits_ = limits;
  went_through_.reset();
  plan();
}

void AxisMotion::stop(const LineLimits& limits) noexcept {
  goal_ = Goal::Rest;
  went_through_.reset();
  limits_ = limits;
  plan();
}

void AxisMotion::set_override(double part) noexcept {
  part = part < kStill ? 0 : std::min(part, 1.0);
  if (part != override_) {
    override_ = part;
    if (goal_ != Goal::Rest && !along()) {
      plan();
    }
  }
}

bool AxisMotion::held() const noexcept {
  return goal_ != Goal::Rest && !along() && override_ == 0;
}

void AxisMotion::plan() noexcept {
  if (lent_) {
    return;
  }
  time_ = 0;
  passing_ = passed_ = false;
  plan_wanted();
  harder_ = !keeps_bounds();
  if (harder_) {
    passing_ = false;
    profile_ = Profile::to_velocity(state_, 0, hardest());
  }
  on_last_way_ = on_last_way_ || (goal_ == Goal::Through && passing_);
}

LineLimits AxisMotion::hardest() const noexcept {
  return {most_.velocity, std::max(most_.acceleration, limits_.acceleration), std::max(most_.jerk, limits_.jerk)};
}

// An axis at rest need not brake.
bool AxisMotion::keeps_bounds() const noexcept {
  const double speed = std::abs(state_.velocity);
  if (speed == 0 && state_.acceleration == 0) {
    return true;
  }
  if (profile_.peak().velocity > std::max(most_.velocity, speed) * (1 + kMotionRounding)) {
    return false;
  }
  if (passing_) {
    return true;  // straight to a target between the ends
  }
  const auto [low, high] = profile_.extent();
  const auto [start, end] = std::minmax(state_.position, profile_.end().position);
  return low >= std::min(lower_, state_.position) - kMotionRounding &&
         high <= std::max(upper_, state_.position) + kMotionRounding &&
         (low >= start - kMotionRounding || turns_in_time(-1)) && (high <= end + kMotionRounding || turns_in_time(1));
}

// An axis that turns back before an end keeps braking through standstill, as it could also have come to rest there. It
// always has to be able to rest before the end, or at least no nearer to it than if it braked now.
bool AxisMotion::turns_in_time(double side) const noexcept {
  constexpr int kSamples = 32;
  constexpr double kMargin = 2e-3;  // rad, between two samples
  const LineLimits hard = hardest();
  const auto rest = [&](const LineState& from) { return side * (from.position + ramp(from, 0, hard).distance); };
  const double most = std::max((side > 0 ? upper_ : -lower_) - kMargin, rest(state_)) + kMotionRounding;
  // Until it turns back, if it does.
  int turned = 1;
  while (turned < kSamples && side * profile_.at(profile_.duration() * turned / kSamples).velocity > 0) {
    ++turned;
  }
  const double until = turned < kSamples ? profile_.duration() * turned / kSamples : profile_.duration();
  for (int i = 1; i <= kSamples; ++i) {
    const LineState there = profile_.at(until * i / kSamples);
    if (side * there.velocity > 0 && rest(there) > most) {
      return false;
    }
  }
  return true;
}

void AxisMotion::plan_wanted() noexcept {
  if (goal_ == Goal::Rest || held()) {
    profile_ = Profile::to_velocity(state_, 0, limits_);
  } else if (goal_ == Goal::Velocity) {
    profile_ = Profile::to_velocity(state_, override_ * target_, limits_);
  } else if (goal_ == Goal::Through) {
    plan_through();
  } else if (!plan_pass(target_ < state_.position ? -1 : 1, override_ * arrival_)) {
    profile_ =
        Profile::to_rest(state_, target_, {override_ * limits_.velocity, limits_.acceleration, limits_.jerk}, braking_);
  }
}

// If it is to be faster at the end than on the way there, it speeds up just before the end. Returns false if that
// profile does not lead through the position; then it ends there.
bool AxisMotion::plan_pass(double sign, double arrival) noexcept {
  const double length = std::abs(target_ - state_.position);
  if (arrival <= 0 || sign * state_.velocity < 0) {
    return false;
  }
  const LineState from{0, sign * state_.velocity, sign * state_.acceleration};
  LineLimits limits = limits_;
  limits.velocity *= override_;
  const LineState cruising{0, limits.velocity, 0};
  const LineLimits most{std::max(arrival, limits.velocity), limits.acceleration, limits.jerk};
  const double gaining = arrival > limits.velocity ? ramp(cruising, arrival, most).distance : 0;
  const bool room = ramp(from, limits.velocity, limits, braking_).distance + gaining <= length;
  profile_ = room ? Profile::to_position(from, length - gaining, std::min(arrival, limits.velocity), limits, braking_)
                  : Profile::to_position(from, length, arrival, most, braking_);
  if (profile_.overshoots()) {
    return false;
  }
  passing_ = true;
  base_ = state_.position;
  sign_ = sign;
  faster_ = room && gaining > 0 ? Profile::to_velocity(profile_.end(), arrival, most) : Profile::coast(profile_.end());
  return true;
}

LineState AxisMotion::on_profile(double time) const noexcept {
  if (along()) {
    return table_.at(time);
  }
  if (!passing_) {
    return profile_.at(time);
  }
  const LineState way = time < profile_.duration() ? profile_.at(time) : faster_.at(time - profile_.duration());
  return {base_ + sign_ * way.position, sign_ * way.velocity, sign_ * way.acceleration};
}

void AxisMotion::step(double seconds) noexcept {
  time_ += seconds;
  if (along()) {
    step_along();
    return;
  }
  if (goal_ == Goal::Through && !held() && !harder_) {
    step_through();
    return;
  }
  const double end = profile_.duration() + faster_.duration();
  if (passing_ && time_ >= end) {
    state_ = on_profile(end);
    state_.position = target_;
    left_over_ = time_ - end;
    time_ = end;
    passed_ = true;
    return;
  }
  state_ = on_profile(time_);
  if (harder_) {
    plan();
    return;
  }
  if (goal_ == Goal::Position && !passing_ && done()) {
    goal_ = Goal::Rest;  // it has arrived
  }
}

}  // namespace indurop::robot
