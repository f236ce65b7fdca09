// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/profile.h"

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/bisect.h"

namespace indurop::robot {

namespace {

LineState advanced(const LineState& from, double t, double jerk) noexcept {
  return {from.position + t * (from.velocity + t * (from.acceleration / 2 + t * jerk / 6)),
          from.velocity + t * (from.acceleration + t * jerk / 2), from.acceleration + t * jerk};
}

double sum_of_phases(const Ramp& ramp, const LineState& from) noexcept {
  LineState state{0, from.velocity, from.acceleration};
  for (const auto& phase : ramp.phases) {
    state = advanced(state, phase.duration, phase.jerk);
  }
  return state.position;
}

LineState after(const Ramp& ramp, const LineState& from, double time) noexcept {
  LineState state = from;
  for (const auto& phase : ramp.phases) {
    const double t = std::clamp(time, 0.0, phase.duration);
    state = advanced(state, t, phase.jerk);
    time -= phase.duration;
  }
  return state;
}

// Bisects between `fits`, with a length that fits into `length`, and `beyond`, with one that does not: returns the last
// argument that fits.
template <class Way>
double just_fitting(double fits, double beyond, double length, const Way& way) noexcept {
  const auto apart = [](const Bisected& now) {
    return std::abs(now.fails - now.holds) > 1e-15 * (now.fails + now.holds);
  };
  return bisect(
             {fits, beyond}, 60, [&](double argument) { return way(argument) <= length; }, apart)
      .holds;
}

// Finds the argument from 0 to `most` where `excess`, which falls and is infinite at 0, becomes 0: one where it is from
// 0 to `slack`. Uses secants; an end that stays twice has half the weight.
template <class Excess>
double root(double most, double slack, const Excess& excess) noexcept {
  double low = 0;
  double high = most;
  double above = HUGE_VAL;
  double below = excess(most);
  int side = 0;
  for (int i = 0; i < 100 && high - low > 1e-15 * high; ++i) {
    const bool known = std::isfinite(above) && std::isfinite(below);
    const double secant = known ? low + (high - low) * above / (above - below) : 0;
    const double middle = secant > low && secant < high ? secant : (low + high) / 2;
    const double there = excess(middle);
    if (there >= 0) {
      low = middle;
      above = there;
      below *= side > 0 ? 0.5 : 1;
      side = 1;
    } else {
      high = middle;
      below = there;
      above *= side < 0 ? 0.5 : 1;
      side = -1;
    }
    if (there >= 0 && there <= slack) {
      break;
    }
  }
  return low;
}

}  // namespace

double unloaded(const LineState& from, const LineLimits& limits) noexcept {
  return from.velocity + from.acceleration * std::abs(from.acceleration) / (2 * limits.jerk);
}

double Ramp::duration() const noexcept {
  return phases[0].duration + phases[1].duration + phases[2].duration;
}

Ramp ramp(const LineState& from, double velocity, const LineLimits& limits) noexcept {
  // Computed as a rising ramp; a falling one is mirrored.
  const double sign = velocity >= unloaded(from, limits) ? 1 : -1;
  const double a0 = sign * from.acceleration;
  const double gain = sign * (velocity - from.velocity);
  const double jerk = limits.jerk;
  const double peak = std::min(std::sqrt(std::max(0.0, jerk * gain + a0 * a0 / 2)), limits.acceleration);
  // An acceleration above the limit (which has just been reduced) is reduced first.
  const double first = peak >= a0 ? 1 : -1;
  const double first_gain = first * (peak * peak - a0 * a0) / (2 * jerk);
  const double last_gain = peak * peak / (2 * jerk);
  Ramp result;
  result.phases[0] = {std::abs(peak - a0) / jerk, sign * first * jerk};
  result.phases[1] = {peak > 0 ? std::max(0.0, (gain - first_gain - last_gain) / peak) : 0, 0};
  result.phases[2] = {peak / jerk, -sign * jerk};
  result.distance = sum_of_phases(result, from);
  return result;
}

Ramp ramp(const LineState& from, double velocity, const LineLimits& limits, const LineLimits& braking) noexcept {
  const bool faster = velocity > 0 && unloaded(from, limits) < velocity;
  return ramp(from, velocity, faster ? limits : braking);
}

Profile Profile::coast(const LineState& state) noexcept {
  Profile profile;
  profile.start_ = profile.end_ = state;
  return profile;
}

void Profile::append(double duration, double jerk) noexcept {
  if (duration > 0) {
    phases_[static_cast<std::size_t>(count_++)] = {duration, jerk};
    duration_ += duration;
    end_ = advanced(end_, duration, jerk);
  }
}

void Profile::append(const Ramp& ramp) noexcept {
  for (const auto& phase : ramp.phases) {
    append(phase.duration, phase.jerk);
  }
  end_.acceleration = 0;  // equal except for rounding
}

Profile Profile::to_velocity(const LineState& from, double velocity, const LineLimits& limits) noexcept {
  Profile profile = coast(from);
  velocity = std::clamp(velocity, -limits.velocity, limits.velocity);
  profile.append(ramp(from, velocity, limits));
  profile.end_.velocity = velocity;
  return profile;
}

// First the ramp towards top speed, then down to the last speed: the later it leaves the first ramp the longer the
// distance, and the limits are fully used all the way.
void Profile::append_way(double length, double last, const LineLimits& limits, const LineLimits& braking) noexcept {
  const LineState from{0, end_.velocity, end_.acceleration};
  const Ramp up = ramp(from, limits.velocity, limits);
  const auto way = [&](double time) {
    const LineState there = after(up, from, time);
    return there.position + ramp(there, last, limits, braking).distance;
  };
  double time = up.duration();
  double cruise = 0;
  // Exactly at the top speed: a rounding error would become its square root in time.
  const double all = up.distance + ramp({0, limits.velocity, 0}, last, braking).distance;
  if (all <= length) {
    cruise = limits.velocity > 0 ? (length - all) / limits.velocity : 0;
  } else {
    time = just_fitting(0, time, length, way);
  }
  double left = time;
  for (const auto& phase : up.phases) {
    append(std::min(left, phase.duration), phase.jerk);
    left = std::max(0.0, left - phase.duration);
  }
  if (cruise > 0) {
    end_.acceleration = 0;
    end_.velocity = limits.velocity;
    append(cruise, 0);
  }
  append(ramp(end_, last, limits, braking));
}

Profile Profile::to_position(const LineState& from, double position, double arrival, const LineLimits& limits,
                             const LineLimits& braking) noexcept {
  const double length = position - from.position;
  double last = std::min(arrival, limits.velocity);
  const auto straight = [&](double velocity) { return ramp(from, velocity, limits, braking).distance; };
  Profile profile = coast(from);
  if (straight(last) <= length) {
    profile.append_way(length, last, limits, braking);
  } else {
    // Too short to reach the requested velocity: as near to it as possible, but when slowing down not above `arrival`.
    const double at_least = unloaded(from, limits);
    double nearest = last < at_least ? std::min(at_least, arrival) : std::max(at_least, 0.0);
    nearest = straight(nearest) <= length ? nearest : 0;
    profile.overshoots_ = straight(nearest) > length * (1 + 1e-9) + 1e-12;
    last = straight(nearest) > length ? 0 : just_fitting(nearest, last, length, straight);
    profile.append(ramp(from, last, limits, braking));
  }
  if (!profile.overshoots_) {
    profile.end_.position = position;
  }
  profile.end_.velocity = last;
  return profile;
}

Profile Profile::to_rest(const LineState& from, double position, const LineLimits& limits,
                         const LineLimits& braking) noexcept {
  const double length = position - from.position;
  const double stopping = ramp(from, 0, braking).distance;
  // The place where it comes to rest if it brakes at once determines the direction; the opposite direction is mirrored.
  const double sign = length < stopping ? -1 : 1;
  Profile profile = coast({0, sign * from.velocity, sign * from.acceleration});
  profile.append_way(std::max(sign * length, sign * stopping), 0, limits, braking);
  profile.mirror(sign, from, position);
  return profile;
}

// Turns the mirrored profile into a motion from `from` to rest at `position`.
void Profile::mirror(double sign, const LineState& from, double position) noexcept {
  for (auto& phase : phases_) {
    phase.jerk *= sign;
  }
  start_ = from;
  end_ = {position, 0, 0};
}

Profile Profile::slower(const LineLimits& limits, double duration) const noexcept {
  if (!(duration_ < duration)) {
    return *this;
  }
  const double length = end_.position - start_.position;
  const double sign = length < ramp(start_, 0, limits).distance ? -1 : 1;
  const LineState from{0, sign * start_.velocity, sign * start_.acceleration};
  const auto cruise = [&](double speed) {
    return (sign * length - ramp(from, speed, limits).distance - ramp({0, speed, 0}, 0, limits).distance) / speed;
  };
  const auto excess = [&](double speed) {
    const double cruising = cruise(speed);
    return cruising < 0
               ? -HUGE_VAL
               : cruising + ramp(from, speed, limits).duration() + ramp({0, speed, 0}, 0, limits).duration() - duration;
  };
  const double speed = root(limits.velocity, 1e-13 * duration, excess);
  Profile profile = coast(from);
  profile.append(ramp(from, speed, limits));
  profile.end_.velocity = speed;
  profile.append(cruise(speed), 0);
  profile.append(ramp({0, speed, 0}, 0, limits));
  profile.mirror(sign, start_, end_.position);
  constexpr double kRounding = 1e-9;
  return std::abs(profile.duration_ - duration) < kRounding * (1 + duration) ? profile : *this;
}

double Profile::jerk_at(double time) const noexcept {
  for (int i = 0; i < count_; ++i) {
    const auto& phase = phases_[static_cast<std::size_t>(i)];
    if (time < phase.duration) {
      return phase.jerk;
    }
    time -= phase.duration;
  }
  return 0;
}

LineState Profile::peak() const noexcept {
  LineState peak{0, std::abs(start_.velocity), std::abs(start_.acceleration)};
  LineState state = start_;
  const auto see = [&peak](const LineState& at) {
    peak = {0, std::max(peak.velocity, std::abs(at.velocity)), std::max(peak.acceleration, std::abs(at.acceleration))};
  };
  for (int i = 0; i < count_; ++i) {
    const auto& phase = phases_[static_cast<std::size_t>(i)];
    const double turn = phase.jerk != 0 ? -state.acceleration / phase.jerk : 0;
    see(advanced(state, std::clamp(turn, 0.0, phase.duration), phase.jerk));
    state = advanced(state, phase.duration, phase.jerk);
    see(state);
  }
  return peak;
}

std::pair<double, double> Profile::extent() const noexcept {
  std::pair<double, double> extent{std::min(start_.position, end_.position), std::max(start_.position, end_.position)};
  LineState state = start_;
  for (int i = 0; i < count_; ++i) {
    const auto& phase = phases_[static_cast<std::size_t>(i)];
    // Times at which its velocity becomes 0, at most two; NaN if it never does.
    const double root = std::sqrt(state.acceleration * state.acceleration - 2 * phase.jerk * state.velocity);
    const double before = -state.acceleration - std::copysign(root, state.acceleration);
    for (const double turn : {before / phase.jerk, 2 * state.velocity / before}) {
      if (turn > 0 && turn < phase.duration) {
        const double position = advanced(state, turn, phase.jerk).position;
        extent = {std::min(extent.first, position), std::max(extent.second, position)};
      }
    }
    state = advanced(state, phase.duration, phase.jerk);
  }
  return extent;
}

LineState Profile::at(double time) const noexcept {
  if (time >= duration_) {
    LineState state = end_;
    state.position += (time - duration_) * end_.velocity;
    return state;
  }
  LineState state = start_;
  for (int i = 0; i < count_; ++i) {
    const auto& phase = phases_[static_cast<std::size_t>(i)];
    const double t = std::min(time, phase.duration);
    state = advanced(state, t, phase.jerk);
    time -= phase.duration;
    if (time <= 0) {
      break;
    }
  }
  return state;
}

}  // namespace indurop::robot
