// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/set_point_gate.h"

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/bisect.h"

namespace indurop::robot {

namespace {

constexpr double kPlanRounding = 1e-4;  // part of a limit: covers the rounding of plans
constexpr double kEdge = 1e-9;          // rad, the same at the end of an axis
// rad or m: the error that rounding adds to a set point where joints turn far over a short distance, next to singular
// positions. It is far below the resolution of a drive, but differences over short periods show it: one of order n has
// 2^n times this error.
constexpr double kNoise = 5e-11;

// Speed at the end if the acceleration becomes `a` in this period and is then reduced to 0 as fast as possible.
double speed_unloaded(double velocity, double a, double step, double period) noexcept {
  const double size = std::abs(a);
  const double steps = std::max(0.0, std::ceil(size / step) - 1);
  return velocity + period * (a + std::copysign(steps * size - step * steps * (steps + 1) / 2, a));
}

}  // namespace

void SetPointGate::stand(double position) noexcept {
  state_ = {position, 0, 0};
  steady_ = 0;
}

void SetPointGate::follow(double position, double velocity) noexcept {
  state_ = {position, velocity, 0};
  steady_ = 0;
}

LineLimits SetPointGate::harder(double hardness) const noexcept {
  return {limits_.velocity, limits_.acceleration * hardness, limits_.jerk * hardness * hardness};
}

LineState SetPointGate::after(double position) const noexcept {
  const double velocity = (position - state_.position) / period_;
  return {position, velocity, (velocity - state_.velocity) / period_};
}

void SetPointGate::pass(double position, double hardness) noexcept {
  state_ = after(position);
  const double step = most_step(hardness);
  steady_ = std::clamp(state_.acceleration, steady_ - step, steady_ + step);
}

double SetPointGate::most_step(double hardness) const noexcept {
  return harder(hardness).jerk * period_ * (1 + kPlanRounding);
}

// The limits apply to differences between set points, so the ramp is made of differences: exact for any period.
LineState SetPointGate::braked(LineState state, const LineLimits& limits) const noexcept {
  const double step = limits.jerk * period_;
  const double most = limits.acceleration;
  double low = std::clamp(state.acceleration - step, -most, most);
  double high = std::clamp(state.acceleration + step, -most, most);
  if (std::abs(state.velocity) < 1e-12 && low <= 0 && high >= 0) {
    return {state.position, 0, 0};
  }
  const auto end = [&](double a) { return speed_unloaded(state.velocity, a, step, period_); };
  if (end(low) > 0) {
    high = low;
  } else if (end(high) < 0) {
    low = high;
  }
  // Once the acceleration is being reduced, this is the next value.
  const double back = state.acceleration > 0 ? low : high;
  if (std::abs(end(back)) < 1e-13) {
    low = high = back;
  }
  const auto apart = [most](const Bisected& now) { return now.fails - now.holds > 1e-15 * most; };
  state.acceleration = bisect(
                           {low, high}, 60, [&](double a) { return !(end(a) > 0); }, apart)
                           .middle();
  state.velocity += state.acceleration * period_;
  state.position += state.velocity * period_;
  return state;
}

void SetPointGate::brake(double hardness) noexcept {
  state_ = braked(state_, harder(hardness));
  steady_ = state_.acceleration;
}

LineState SetPointGate::unloaded() const noexcept {
  const double step = limits_.jerk * period_;
  const double a =
      std::abs(state_.acceleration) <= step ? 0 : state_.acceleration - std::copysign(step, state_.acceleration);
  const double velocity = state_.velocity + a * period_;
  return {state_.position + velocity * period_, velocity, a};
}

bool SetPointGate::coasts() const noexcept {
  // Rounding of set points that belong to no path: in short periods it is as large as a change by the jerk limit.
  const double rounding = 1e-15 * (100 + std::abs(state_.position));
  return std::abs(state_.acceleration) <= 4 * rounding / (period_ * period_);
}

// Keeps half of the tolerance for rounding in reserve, so that check() accepts the result.
double SetPointGate::nearest(double wanted) const noexcept {
  constexpr double kMargin = 1 + kPlanRounding / 2;
  const double step = limits_.jerk * period_ * kMargin;
  const double most = limits_.acceleration * kMargin;
  double low = std::max(steady_ - step, -most);
  double high = std::min(steady_ + step, most);
  // The speed that it would reach even if the acceleration were reduced at once.
  const auto fastest = [&](double a) {
    return speed_unloaded(state_.velocity + a * period_, a, limits_.jerk * period_, period_) - a * period_;
  };
  const auto slowest = [&](double good, double bad, double sign) {
    const auto too_fast = [&](double a) { return sign * fastest(a) > limits_.velocity * kMargin; };
    return bisect(
               {good, bad}, 50, [&](double a) { return !too_fast(a); },
               [&](const Bisected& now) { return too_fast(now.fails); })
        .holds;
  };
  if (fastest(high) > limits_.velocity * kMargin) {
    high = slowest(low, high, 1);
  }
  if (-fastest(low) > limits_.velocity * kMargin) {
    low = slowest(high, low, -1);
  }
  const double asked = after(wanted).acceleration;
  if (asked >= low && asked <= high) {
    return wanted;
  }
  const double a = std::clamp(asked, low, high);
  return state_.position + (state_.velocity + a * period_) * period_;
}

// An axis beyond a limit may stay there and return, but not move further out.
bool SetPointGate::may_be(double position) const noexcept {
  return position >= std::min(range_.lower - kEdge, state_.position) &&
         position <= std::max(range_.upper + kEdge, state_.position);
}

bool SetPointGate::can_rest(LineState state, const LineLimits& limits) const noexcept {
  // Far from the limits an estimate that is too long is sufficient.
  const double speed = std::abs(state.velocity) + period_ * std::abs(state.acceleration);
  const double unload = limits.acceleration / limits.jerk + period_;
  const double longest =
      speed * (speed / (2 * limits.acceleration) + 3 * unload) + std::abs(state.acceleration) * unload * unload;
  if (state.position - longest > range_.lower && state.position + longest < range_.upper) {
    return true;
  }
  while (state.velocity != 0 || state.acceleration != 0) {
    if (!may_be(state.position)) {
      return false;
    }
    state = braked(state, limits);
  }
  return may_be(state.position);
}

ErrorCode SetPointGate::check(double position, double hardness) const noexcept {
  if (!std::isfinite(position)) {
    return ErrorCode::Value;
  }
  const LineLimits limits = harder(hardness);
  const LineState next = after(position);
  const double margin = 1 + kPlanRounding;
  if (!may_be(position)) {
    return ErrorCode::JointLimit;
  }
  const double fastest = limits.velocity * margin + 2 * kNoise / period_;
  const double noise = 4 * kNoise / (period_ * period_);  // of the acceleration
  if (std::abs(next.velocity) > fastest) {
    return ErrorCode::Speed;
  }
  if (std::abs(next.acceleration) > limits.acceleration * margin + noise) {
    return ErrorCode::Acceleration;
  }
  if (std::abs(next.acceleration - steady_) > most_step(hardness) + 2 * noise) {
    return ErrorCode::Jerk;
  }
  // A speed that would exceed the limit while its acceleration is reduced would have to be rejected later: reject it
  // now.
  const double sure = std::copysign(std::max(0.0, std::abs(next.acceleration) - noise), next.acceleration);
  if (std::abs(speed_unloaded(next.velocity, sure, limits.jerk * period_, period_) - period_ * sure) > fastest) {
    return ErrorCode::Speed;
  }
  return can_rest(next, limits) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

}  // namespace indurop::robot
