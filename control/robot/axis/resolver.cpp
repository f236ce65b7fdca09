// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/resolver.h"

#include <algorithm>
#include <cmath>

#include "control/robot/axis/service.h"

namespace indurop::robot {

namespace {

// Returns whether a requested value in deg/s, deg/s^2, deg/s^3 or mm is negligible, but not 0 (0: the maximum).
bool nothing(double value) noexcept {
  return value != 0 && std::abs(value) < 1e-6;
}

}  // namespace

// Returns the target in the turn that the direction requires.
double CommandResolver::turned(double target, double from, Direction direction) const noexcept {
  if (!parts_.bounds.endless() || direction == Direction::None) {
    return target;
  }
  double ahead = std::fmod(target - from, 2 * kPi);
  ahead += ahead < 0 ? 2 * kPi : 0;
  const double speed = parts_.motion.state().velocity;
  const bool shortest = direction == Direction::Shortest || (direction == Direction::Current && speed == 0);
  const bool back = direction == Direction::Negative || (direction == Direction::Current && speed < 0);
  const bool turn_back = ahead > 0 && (shortest ? ahead > kPi : back);
  return from + (turn_back ? ahead - 2 * kPi : ahead);
}

ErrorCode CommandResolver::resolve(const Command& command, double from, AxisOrder& order) const noexcept {
  if (const ErrorCode code = limit(command, order); code != ErrorCode::Ok) {
    return code;
  }
  switch (const AxisService service = axis_service_of(command)) {
    case AxisService::TorqueControl:
      return parts_.pushing.resolve(command, parts_.motion.state().velocity, order);
    default:
      if (follows(service)) {
        AxisFollow way;
        return follow(command, order, way);
      }
      return is_move(service) || goes_on_from(service) ? target(command, from, order) : ErrorCode::Ok;
  }
}

ErrorCode CommandResolver::resolve_whole(const Command& command, double from, AxisOrder& order) const noexcept {
  const ErrorCode code = resolve(command, from, order);
  return code == ErrorCode::Ok ? check_way(command, order) : code;
}

// Sets the limits of the motion, and the velocity of one that has no other target.
ErrorCode CommandResolver::limit(const Command& command, AxisOrder& order) const noexcept {
  const AxisService service = axis_service_of(command);
  const bool to_velocity = service == AxisService::MoveVelocity;
  const double speed = to_velocity ? std::abs(command.velocity) : command.velocity;
  const double slowing = command.deceleration == 0 ? command.acceleration : command.deceleration;
  if (!std::isfinite(command.to[0]) || !std::isfinite(command.velocity) ||
      !(speed >= 0 && command.acceleration >= 0 && command.deceleration >= 0 && command.jerk >= 0) || nothing(speed) ||
      nothing(command.acceleration) || nothing(command.deceleration) || nothing(command.jerk) ||
      command.direction < Direction::None || command.direction > Direction::Current) {
    return ErrorCode::Value;
  }
  const AxisBounds& bounds = parts_.bounds;
  const AxisBounds::Own& own = bounds.own();
  const auto chosen = [this](double wanted, double most) {
    return wanted == 0 ? most : std::min(wanted * parts_.units.unit(), most);
  };
  const double harder = bounds.acceleration_factor();
  order.limits = {chosen(speed, own.velocity), harder * chosen(command.acceleration, own.acceleration),
                  bounds.jerk_factor() * chosen(command.jerk, own.jerk)};
  order.braking = {order.limits.velocity, harder * chosen(slowing, own.deceleration), order.limits.jerk};
  if (service == AxisService::Stop) {
    const LineLimits& most = bounds.most();
    order.braking = {most.velocity, chosen(slowing, most.acceleration), chosen(command.jerk, most.jerk)};
  }
  if (to_velocity) {
    const bool back = command.direction == Direction::Negative ||
                      (command.direction == Direction::Current && parts_.motion.state().velocity < 0);
    const bool negative = (command.velocity < 0) != back;
    order.target = negative ? -order.limits.velocity : order.limits.velocity;
  }
  return ErrorCode::Ok;
}

ErrorCode CommandResolver::target(const Command& command, double from, AxisOrder& order) const noexcept {
  const AxisService service = axis_service_of(command);
  const double end = goes_on_from(service) ? command.to[1] : 0;
  if (!std::isfinite(end) || nothing(end)) {
    return ErrorCode::Value;
  }
  order.end = std::clamp(end * parts_.units.unit(), -parts_.bounds.own().velocity, parts_.bounds.own().velocity);
  const bool absolute = service == AxisService::MoveAbsolute || service == AxisService::MoveContinuousAbsolute;
  if (absolute && !parts_.homed) {
    return ErrorCode::NotHomed;
  }
  const double asked = command.to[0] * parts_.units.unit();
  order.target = absolute ? turned(asked + parts_.units.origin(), from, command.direction) : from + asked;
  return parts_.bounds.inside(order.target, order.target) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

// A motion that continues after a position has to be able to rest after it before the end of the axis, and also where
// it takes its run-up.
ErrorCode CommandResolver::check_way(const Command& command, const AxisOrder& order) const noexcept {
  if (is_profile(axis_service_of(command))) {
    return check_profile(command);
  }
  if (!goes_on_from(axis_service_of(command))) {
    return ErrorCode::Ok;
  }
  const AxisBounds& bounds = parts_.bounds;
  const auto first =
      AxisMotion::rests_first(parts_.motion.state(), order.target, order.end, order.limits, order.braking);
  const double rest = order.target + ramp({0, order.end, 0}, 0, bounds.limits(1)).distance;
  return bounds.clear(rest) && (!first || bounds.clear(*first)) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

}  // namespace indurop::robot
