// SPDX-License-Identifier: Apache-2.0
// Resolves motions by a time table: the table from the present state of the axis, and whether it keeps all limits.

#include <algorithm>
#include <cmath>

#include "control/robot/axis/resolver.h"
#include "control/robot/axis/service.h"

namespace indurop::robot {

// Reads a table that begins at the present state of the axis.
ErrorCode CommandResolver::read_table(const Command& command, TimeProfile& table) const noexcept {
  const auto number = static_cast<std::size_t>(command.job) - 1;
  if (number >= kProfiles || command.number == 0 || (*parts_.row.profiles)[number].command != command.number) {
    return ErrorCode::Value;
  }
  const LineState& now = parts_.motion.state();
  TimeProfile::Scale scale{command.to[0], command.to[1] * parts_.units.unit(), command.to[2] * parts_.units.unit()};
  auto of = TimeProfile::Of::Acceleration;
  if (axis_service_of(command) == AxisService::VelocityProfile) {
    of = TimeProfile::Of::Velocity;
  } else if (axis_service_of(command) == AxisService::PositionProfile) {
    of = TimeProfile::Of::Position;
    scale.offset += command.option == 1 ? now.position : parts_.units.origin();
    if (command.option != 1 && !parts_.homed) {
      return ErrorCode::NotHomed;
    }
  }
  return table.set((*parts_.row.profiles)[number], of, scale, now);
}

// Checks the whole path before anything moves.
ErrorCode CommandResolver::check_profile(const Command& command) const noexcept {
  constexpr double kRounding = 1e-6;
  const AxisBounds& bounds = parts_.bounds;
  const AxisFollowing& following = parts_.following;
  TimeProfile table;
  if (const ErrorCode code = read_table(command, table); code != ErrorCode::Ok) {
    return code;
  }
  if (following.coupled() || following.over() || following.leaving() || !parts_.motion.full_speed()) {
    return ErrorCode::State;
  }
  const TimeProfile::Ranges all = table.ranges();
  const double hardest = bounds.acceleration_factor() * std::min(bounds.own().acceleration, bounds.own().deceleration);
  const LineState end = table.at(table.duration());
  if (all.velocity.peak() > bounds.own().velocity * (1 + kRounding) ||
      std::abs(unloaded(end, bounds.most())) > bounds.own().velocity * (1 + kRounding)) {
    return ErrorCode::Speed;
  }
  if (all.acceleration.peak() > hardest * (1 + kRounding)) {
    return ErrorCode::Acceleration;
  }
  if (all.jerk.peak() > bounds.jerk_factor() * bounds.own().jerk * (1 + kRounding)) {
    return ErrorCode::Jerk;
  }
  if (!bounds.inside(all.position.least, all.position.greatest)) {
    return ErrorCode::JointLimit;
  }
  const double rest = end.position + ramp(end, 0, bounds.limits(1)).distance;
  const bool clear = axis_service_of(command) == AxisService::PositionProfile || bounds.clear(rest);
  return clear ? ErrorCode::Ok : ErrorCode::JointLimit;
}

}  // namespace indurop::robot
