// SPDX-License-Identifier: Apache-2.0
// Parameters of a single axis that programs write: ends and limits of its motions as a single axis, never beyond those
// of the axis.

#include <algorithm>
#include <cmath>

#include "control/robot/axis/control.h"

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

}  // namespace

void AxisControl::write_parameter(int ticket, const Command& command) noexcept {
  Owner owner{ticket, AxisService::WriteParameter};
  finish(owner, change(command.option, command.to[0]));
}

// Limits apply to motions that begin. Writing a read-only parameter or an impossible value returns Value.
ErrorCode AxisControl::change(int parameter, double value) noexcept {
  if (!std::isfinite(value)) {
    return ErrorCode::Value;
  }
  const double scaled = value * scale_.unit;
  Own own = own_;
  switch (static_cast<Parameter>(parameter)) {
    case Parameter::UpperEnd:
      own.upper = scaled + origin_;
      return change_ends(own);
    case Parameter::LowerEnd:
      own.lower = scaled + origin_;
      return change_ends(own);
    case Parameter::UpperEndCounts:
      own.upper_counts = value != 0;
      return change_ends(own);
    case Parameter::LowerEndCounts:
      own.lower_counts = value != 0;
      return change_ends(own);
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

// Only possible while the axis rests between the ends: no motion may be on its way to a position beyond the new ones.
ErrorCode AxisControl::change_ends(const Own& own) noexcept {
  constexpr double kSlack = 1e-9;
  if (endless_ || !(own.lower < own.upper) || own.lower < least_ - kSlack || own.upper > greatest_ + kSlack) {
    return ErrorCode::Value;
  }
  if (busy() || in_group() || queued_ > 0) {
    return ErrorCode::State;
  }
  const double place = commanded().position;
  const bool beyond =
      (own.upper_counts && place > own.upper + kSlack) || (own.lower_counts && place < own.lower - kSlack);
  if (beyond) {
    return ErrorCode::JointLimit;
  }
  own_ = own;
  keep_ends();
  return ErrorCode::Ok;
}

void AxisControl::keep_ends() noexcept {
  lower_ = own_.lower_counts ? std::max(own_.lower, least_) : least_;
  upper_ = own_.upper_counts ? std::min(own_.upper, greatest_) : greatest_;
  motion_.set_bounds(most_, endless_ ? -HUGE_VAL : lower_, endless_ ? HUGE_VAL : upper_);
}

void AxisControl::report_own(AxisReport& report) const noexcept {
  report.own_lower = (own_.lower - origin_) / scale_.unit;
  report.own_upper = (own_.upper - origin_) / scale_.unit;
  report.lower_counts = own_.lower_counts;
  report.upper_counts = own_.upper_counts;
  report.own_velocity = own_.velocity / scale_.unit;
  report.own_acceleration = own_.acceleration / scale_.unit;
  report.own_deceleration = own_.deceleration / scale_.unit;
  report.own_jerk = own_.jerk / scale_.unit;
}

}  // namespace indurop::robot
