// SPDX-License-Identifier: Apache-2.0
// A single axis that pushes with a torque. It comes to rest, its drive changes to the cyclic torque mode, and from then
// on set points are the position of the axis, so that it can brake from there at any time: by any other command, or
// because it is too fast or too near its end.

#include <algorithm>
#include <cmath>

#include "control/robot/axis/control.h"

namespace indurop::robot {

namespace {

constexpr double kModeTime = 0.5;   // s a drive may take to change its mode
constexpr double kTooFast = 1.2;    // factor on the requested velocity
constexpr double kSlowingTime = 1;  // s to slow down to another velocity
constexpr int kPeriodsTooFast = 2;

}  // namespace

ErrorCode AxisControl::resolve_torque(const Command& command, Order& order) const noexcept {
  if (!std::isfinite(command.to[1]) || command.to[1] < 0) {
    return ErrorCode::Value;
  }
  if (!(most_torque_ > 0)) {
    return ErrorCode::NoTorque;
  }
  if (std::abs(command.to[0]) > most_torque_) {
    return ErrorCode::Torque;
  }
  const bool back = command.direction == Direction::Negative ||
                    (command.direction == Direction::Current && motion_.state().velocity < 0);
  order.target = back ? -command.to[0] : command.to[0];
  order.end = command.to[1];
  return ErrorCode::Ok;
}

void AxisControl::begin_torque(const Order& order) noexcept {
  if (!push_.on()) {
    let_go();
    motion_.stop(order.braking);
    mode_waited_ = 0;
  }
  push_.take({order.target, order.end, order.limits.velocity, order.limits.acceleration});
  slowing_from_ = push_.pushes() ? std::abs(measured_speed_) : 0;
  slowing_ = 0;
  state_ = AxisState::ContinuousMotion;
}

// The drive follows set points again, and the axis brakes from its present position and speed.
void AxisControl::leave_torque() noexcept {
  if (!push_.on()) {
    return;
  }
  const bool pushed = push_.pushes();
  mode_waited_ = 0;
  push_.off();
  drive_.torque(false);
  if (pushed) {
    motion_.reset(motion_.state());
    motion_.stop(limits(1));
  }
}

void AxisControl::fail_torque(ErrorCode code) noexcept {
  abort_queue();
  finish(motion_owner_, code);
  let_go();
  motion_.stop(limits(1));
  state_ = AxisState::Stopping;
}

// A drive that does not leave torque mode follows no set point: power is switched off, so that its brake holds the
// axis.
void AxisControl::watch_mode(const DriveIn& in, double seconds) noexcept {
  in_torque_mode_ = Drive::state_of(in.status) == Drive::State::OperationEnabled && in.mode == Drive::kCyclicTorque;
  if (push_.on()) {
    return;
  }
  mode_waited_ = in_torque_mode_ ? mode_waited_ + seconds : 0;
  if (mode_waited_ > kModeTime) {
    want_power_ = false;
    fail(ErrorCode::Drive, 1);
  }
}

// Returns false if it pushes; its own motion then waits.
bool AxisControl::prepare_torque(double seconds) noexcept {
  using enum TorqueControl::Phase;
  switch (push_.phase()) {
    case Off:
    case Pushing:
      break;
    case Resting:
      mode_waited_ = in_torque_mode_ ? mode_waited_ + seconds : 0;
      if (mode_waited_ > kModeTime) {
        fail_torque(ErrorCode::Drive);  // it has not left that mode yet
      } else if (motion_.at_rest() && !leaving_ && !in_torque_mode_) {
        push_.enter();
        drive_.torque(true);
        mode_waited_ = 0;
        mode_late_ = 0;
      }
      break;
    case Entering:
      ++mode_late_;
      mode_waited_ += seconds;
      if (in_torque_mode_) {
        push_.push(mode_late_);
        mode_waited_ = 0;
        too_fast_ = 0;
      } else if (mode_waited_ > kModeTime) {
        fail_torque(ErrorCode::NoTorque);
      }
      break;
  }
  return !push_.pushes();
}

// The set point is the position that the axis will have when the drive takes it.
void AxisControl::advance_torque(double seconds) noexcept {
  push_.set_override(override_);
  push_.step(measured_speed_, seconds);
  const double ahead = push_.late() * seconds;
  motion_.lend({measured_ + measured_speed_ * ahead, measured_speed_, 0});
  led_by_drive_ = true;
  if (!in_torque_mode_) {
    mode_waited_ += seconds;
    if (mode_waited_ > push_.late() * seconds) {
      fail_torque(ErrorCode::Drive);  // it has changed its mode on its own
    }
    return;
  }
  mode_waited_ = 0;
  if (too_fast(seconds)) {
    fail_torque(ErrorCode::Speed);
  } else if (!rests_in_time(ahead + seconds)) {
    fail_torque(ErrorCode::JointLimit);
  }
}

bool AxisControl::too_fast(double seconds) noexcept {
  const double steps = 2 / std::abs(scale_.counts) / seconds;
  slowing_ += seconds;
  const double velocity = std::max(push_.wish().velocity, slowing_ < kSlowingTime ? slowing_from_ : 0);
  const double most = std::min(kTooFast * velocity, most_.velocity) + steps;
  too_fast_ = std::abs(measured_speed_) > most ? too_fast_ + 1 : 0;
  return too_fast_ >= kPeriodsTooFast;
}

// Returns whether the axis comes to rest before its end, including the speed that the torque adds until the drive
// brakes.
bool AxisControl::rests_in_time(double ahead) const noexcept {
  if (endless_) {
    return true;
  }
  const double more = std::abs(push_.torque()) / push_.load().inertia * ahead;
  const auto rest = [&](double way) {
    const double faster = way * push_.torque() > 0 ? more : 0;
    const double speed = std::max(0.0, way * measured_speed_);
    const double braking = ramp({0, speed + faster, 0}, 0, limits(1)).distance;
    return measured_ + way * ((speed + faster / 2) * ahead + braking);
  };
  const bool up = push_.torque() > 0 || measured_speed_ > 0;
  const bool down = push_.torque() < 0 || measured_speed_ < 0;
  return !(up && rest(1) > upper_ - kEndMargin) && !(down && rest(-1) < lower_ + kEndMargin);
}

}  // namespace indurop::robot
