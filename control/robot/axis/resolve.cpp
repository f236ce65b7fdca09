// SPDX-License-Identifier: Apache-2.0
// Converts a command of a single axis into a motion, from where it is, within its limits and ends.

#include <algorithm>
#include <cmath>

#include "control/robot/axis/control.h"

namespace indurop::robot {

namespace {

// Returns whether a requested value in deg/s, deg/s^2, deg/s^3 or mm is negligible, but not 0 (0: the maximum).
bool nothing(double value) noexcept {
  return value != 0 && std::abs(value) < 1e-6;
}

}  // namespace

bool AxisControl::follows(AxisService service) noexcept {
  return service == AxisService::GearIn || service == AxisService::CamIn || service == AxisService::GearInPos ||
         service == AxisService::Combine;
}

bool AxisControl::is_move(AxisService service) noexcept {
  return service == AxisService::MoveAbsolute || service == AxisService::MoveRelative ||
         service == AxisService::MoveAdditive;
}

bool AxisControl::goes_on_from(AxisService service) noexcept {
  return service == AxisService::MoveContinuousAbsolute || service == AxisService::MoveContinuousRelative;
}

// Returns the target in the turn that the direction requires.
double AxisControl::turned(double target, double from, Direction direction) const noexcept {
  if (!endless_ || direction == Direction::None) {
    return target;
  }
  double ahead = std::fmod(target - from, 2 * kPi);
  ahead += ahead < 0 ? 2 * kPi : 0;
  const double speed = motion_.state().velocity;
  const bool shortest = direction == Direction::Shortest || (direction == Direction::Current && speed == 0);
  const bool back = direction == Direction::Negative || (direction == Direction::Current && speed < 0);
  const bool turn_back = ahead > 0 && (shortest ? ahead > kPi : back);
  return from + (turn_back ? ahead - 2 * kPi : ahead);
}

ErrorCode AxisControl::resolve(const Command& command, double from, Order& order) const noexcept {
  const AxisService service = service_of(command);
  const bool to_velocity = service == AxisService::MoveVelocity;
  const double speed = to_velocity ? std::abs(command.velocity) : command.velocity;
  const double slowing = command.deceleration == 0 ? command.acceleration : command.deceleration;
  if (!std::isfinite(command.to[0]) || !std::isfinite(command.velocity) ||
      !(speed >= 0 && command.acceleration >= 0 && command.deceleration >= 0 && command.jerk >= 0) || nothing(speed) ||
      nothing(command.acceleration) || nothing(command.deceleration) || nothing(command.jerk) ||
      command.direction < Direction::None || command.direction > Direction::Current) {
    return ErrorCode::Value;
  }
  const auto chosen = [this](double wanted, double most) {
    return wanted == 0 ? most : std::min(wanted * scale_.unit, most);
  };
  const double harder = acceleration_factor_;
  order.limits = {chosen(speed, own_.velocity), harder * chosen(command.acceleration, own_.acceleration),
                  jerk_factor_ * chosen(command.jerk, own_.jerk)};
  order.braking = {order.limits.velocity, harder * chosen(slowing, own_.deceleration), order.limits.jerk};
  if (service == AxisService::Stop) {
    order.braking = {most_.velocity, chosen(slowing, most_.acceleration), chosen(command.jerk, most_.jerk)};
  }
  if (to_velocity) {
    const bool back = command.direction == Direction::Negative ||
                      (command.direction == Direction::Current && motion_.state().velocity < 0);
    const bool negative = (command.velocity < 0) != back;
    order.target = negative ? -order.limits.velocity : order.limits.velocity;
  }
  if (service == AxisService::TorqueControl) {
    return resolve_torque(command, order);
  }
  if (follows(service)) {
    Coupled way;
    return resolve(command, order, way);
  }
  if (!is_move(service) && !goes_on_from(service)) {
    return ErrorCode::Ok;
  }
  const double end = goes_on_from(service) ? command.to[1] : 0;
  if (!std::isfinite(end) || nothing(end)) {
    return ErrorCode::Value;
  }
  order.end = std::clamp(end * scale_.unit, -own_.velocity, own_.velocity);
  const bool absolute = service == AxisService::MoveAbsolute || service == AxisService::MoveContinuousAbsolute;
  if (absolute && !homed_) {
    return ErrorCode::NotHomed;
  }
  const double asked = command.to[0] * scale_.unit;
  order.target = absolute ? turned(asked + origin_, from, command.direction) : from + asked;
  return inside(order.target, order.target) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

// A motion that continues after a position has to be able to rest after it before the end of the axis, and also where
// it takes its run-up.
ErrorCode AxisControl::check_way(const Command& command, const Order& order) const noexcept {
  if (is_profile(service_of(command))) {
    return check_profile(command);
  }
  if (!goes_on_from(service_of(command)) || endless_) {
    return ErrorCode::Ok;
  }
  const auto clear = [this](double place) { return place >= lower_ + kEndMargin && place <= upper_ - kEndMargin; };
  const auto first = AxisMotion::rests_first(motion_.state(), order.target, order.end, order.limits, order.braking);
  const double rest = order.target + ramp({0, order.end, 0}, 0, limits(1)).distance;
  return clear(rest) && (!first || clear(*first)) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

}  // namespace indurop::robot
