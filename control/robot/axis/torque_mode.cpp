// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/torque_mode.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kModeTime = 0.5;   // s a drive may take to change its mode
constexpr double kTooFast = 1.2;    // factor on the requested velocity
constexpr double kSlowingTime = 1;  // s to slow down to another velocity
constexpr int kPeriodsTooFast = 2;

}  // namespace

bool TorqueMode::sense(const DriveIn& in, double seconds) noexcept {
  led_by_drive_ = false;
  in_mode_ = Drive::state_of(in.status) == Drive::State::OperationEnabled && in.mode == Drive::kCyclicTorque;
  if (push_.on()) {
    return false;
  }
  waited_ = in_mode_ ? waited_ + seconds : 0;
  return waited_ > kModeTime;
}

ErrorCode TorqueMode::resolve(const Command& command, double speed, AxisOrder& order) const noexcept {
  if (!std::isfinite(command.to[1]) || command.to[1] < 0) {
    return ErrorCode::Value;
  }
  if (!(most_torque_ > 0)) {
    return ErrorCode::NoTorque;
  }
  if (std::abs(command.to[0]) > most_torque_) {
    return ErrorCode::Torque;
  }
  const bool back = command.direction == Direction::Negative || (command.direction == Direction::Current && speed < 0);
  order.target = back ? -command.to[0] : command.to[0];
  order.end = command.to[1];
  return ErrorCode::Ok;
}

void TorqueMode::begin(const AxisOrder& order, double speed) noexcept {
  if (!push_.on()) {
    waited_ = 0;
  }
  push_.take({order.target, order.end, order.limits.velocity, order.limits.acceleration});
  slowing_from_ = push_.pushes() ? std::abs(speed) : 0;
  slowing_ = 0;
}

bool TorqueMode::leave(Drive& drive) noexcept {
  if (!push_.on()) {
    return false;
  }
  const bool pushed = push_.pushes();
  waited_ = 0;
  push_.off();
  drive.torque(false);
  return pushed;
}

ErrorCode TorqueMode::prepare(Drive& drive, bool at_rest, double seconds) noexcept {
  using enum TorqueControl::Phase;
  switch (push_.phase()) {
    case Off:
    case Pushing:
      break;
    case Resting:
      waited_ = in_mode_ ? waited_ + seconds : 0;
      if (waited_ > kModeTime) {
        return ErrorCode::Drive;
      }
      if (at_rest && !in_mode_) {
        push_.enter();
        drive.torque(true);
        waited_ = 0;
        late_ = 0;
      }
      break;
    case Entering:
      ++late_;
      waited_ += seconds;
      if (in_mode_) {
        push_.push(late_);
        waited_ = 0;
        too_fast_ = 0;
      } else if (waited_ > kModeTime) {
        return ErrorCode::NoTorque;
      }
      break;
  }
  return ErrorCode::Ok;
}

ErrorCode TorqueMode::step(const Measured& now, const AxisBounds& bounds, double resolution, double seconds) noexcept {
  push_.step(now.speed, seconds);
  const double ahead = push_.late() * seconds;
  led_by_drive_ = true;
  if (!in_mode_) {
    waited_ += seconds;
    return waited_ > ahead ? ErrorCode::Drive : ErrorCode::Ok;
  }
  waited_ = 0;
  if (too_fast(now.speed, bounds.most().velocity, resolution, seconds)) {
    return ErrorCode::Speed;
  }
  return rests_in_time(now, bounds, ahead + seconds) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

bool TorqueMode::too_fast(double speed, double most, double resolution, double seconds) noexcept {
  const double steps = 2 / resolution / seconds;
  slowing_ += seconds;
  const double velocity = std::max(push_.request().velocity, slowing_ < kSlowingTime ? slowing_from_ : 0);
  too_fast_ = std::abs(speed) > std::min(kTooFast * velocity, most) + steps ? too_fast_ + 1 : 0;
  return too_fast_ >= kPeriodsTooFast;
}

// Returns whether the axis comes to rest before its end, including the speed that the torque adds until the drive
// brakes.
bool TorqueMode::rests_in_time(const Measured& now, const AxisBounds& bounds, double ahead) const noexcept {
  const double more = std::abs(push_.torque()) / push_.load().inertia * ahead;
  const auto rest = [&](double way) {
    const double faster = way * push_.torque() > 0 ? more : 0;
    const double speed = std::max(0.0, way * now.speed);
    const double braking = ramp({0, speed + faster, 0}, 0, bounds.limits(1)).distance;
    return now.position + way * ((speed + faster / 2) * ahead + braking);
  };
  const bool up = push_.torque() > 0 || now.speed > 0;
  const bool down = push_.torque() < 0 || now.speed < 0;
  return !(up && bounds.beyond_upper(rest(1))) && !(down && bounds.beyond_lower(rest(-1)));
}

}  // namespace indurop::robot
