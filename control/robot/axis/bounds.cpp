// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/bounds.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

// Parameter numbers of PLCopen Motion Control, part 1.
enum class Parameter : std::int16_t {
  UpperEnd = 2,
  LowerEnd = 3,
  UpperEndCounts = 4,
  LowerEndCounts = 5,
  LagCounts = 6,
  Velocity = 9,
  Acceleration = 13,
  Deceleration = 15,
  Jerk = 17
};

ErrorCode lower_than(double most, double value, double& limit) noexcept {
  constexpr double kSlack = 1e-9;
  if (!(value >= 1e-6 * most && value <= most * (1 + kSlack))) {
    return ErrorCode::Value;
  }
  limit = std::min(value, most);
  return ErrorCode::Ok;
}

bool sane(double part) noexcept {
  return part > 0 && part <= 1;
}

}  // namespace

AxisBounds::AxisBounds(const Axis& axis, const LineLimits& limits) noexcept
    : own_{axis.lowest(),       axis.highest(),      true,       true, limits.velocity,
           limits.acceleration, limits.acceleration, limits.jerk},
      least_(axis.lowest()),
      greatest_(axis.highest()),
      endless_(axis.endless),
      most_(limits) {
  keep_ends();
}

void AxisBounds::set_factors(double acceleration, double jerk) noexcept {
  acceleration_factor_ = sane(acceleration) ? acceleration : 1;
  jerk_factor_ = sane(jerk) ? jerk : 1;
}

void AxisBounds::apply_to(AxisMotion& motion) const noexcept {
  motion.set_bounds(most_, lower_, upper_);
}

ErrorCode AxisBounds::change(int parameter, double value, const AxisUnits& units, const Present& now) noexcept {
  if (!std::isfinite(value)) {
    return ErrorCode::Value;
  }
  const double scaled = value * units.unit();
  Own own = own_;
  switch (static_cast<Parameter>(parameter)) {
    case Parameter::UpperEnd:
      own.upper = scaled + units.origin();
      return change_ends(own, now);
    case Parameter::LowerEnd:
      own.lower = scaled + units.origin();
      return change_ends(own, now);
    case Parameter::UpperEndCounts:
      own.upper_counts = value != 0;
      return change_ends(own, now);
    case Parameter::LowerEndCounts:
      own.lower_counts = value != 0;
      return change_ends(own, now);
    case Parameter::LagCounts:
      return value != 0 ? ErrorCode::Ok : ErrorCode::Value;  // lag monitoring is always on
    case Parameter::Velocity:
      return lower_than(most_.velocity, scaled, own_.velocity);
    case Parameter::Acceleration:
      return lower_than(most_.acceleration, scaled, own_.acceleration);
    case Parameter::Deceleration:
      return lower_than(most_.acceleration, scaled, own_.deceleration);
    case Parameter::Jerk:
      return lower_than(most_.jerk, scaled, own_.jerk);
    default:
      return ErrorCode::Value;
  }
}

ErrorCode AxisBounds::change_ends(const Own& own, const Present& now) noexcept {
  constexpr double kSlack = 1e-9;
  if (endless_ || !(own.lower < own.upper) || own.lower < least_ - kSlack || own.upper > greatest_ + kSlack) {
    return ErrorCode::Value;
  }
  if (!now.rests) {
    return ErrorCode::State;
  }
  const bool beyond = (own.upper_counts && now.position > own.upper + kSlack) ||
                      (own.lower_counts && now.position < own.lower - kSlack);
  if (beyond) {
    return ErrorCode::JointLimit;
  }
  own_ = own;
  keep_ends();
  return ErrorCode::Ok;
}

void AxisBounds::keep_ends() noexcept {
  lower_ = own_.lower_counts ? std::max(own_.lower, least_) : least_;
  upper_ = own_.upper_counts ? std::min(own_.upper, greatest_) : greatest_;
}

bool AxisBounds::inside(double one, double other) const noexcept {
  return std::min(one, other) >= lower_ - 1e-9 && std::max(one, other) <= upper_ + 1e-9;
}

void AxisBounds::report(const AxisUnits& units, AxisReport& report) const noexcept {
  report.lower = units.for_users(least_);
  report.upper = units.for_users(greatest_);
  report.most_velocity = most_.velocity / units.unit();
  report.most_acceleration = most_.acceleration / units.unit();
  report.most_jerk = most_.jerk / units.unit();
  report.own_lower = units.for_users(own_.lower);
  report.own_upper = units.for_users(own_.upper);
  report.lower_counts = own_.lower_counts;
  report.upper_counts = own_.upper_counts;
  report.own_velocity = own_.velocity / units.unit();
  report.own_acceleration = own_.acceleration / units.unit();
  report.own_deceleration = own_.deceleration / units.unit();
  report.own_jerk = own_.jerk / units.unit();
}

}  // namespace indurop::robot
