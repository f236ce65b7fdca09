// SPDX-License-Identifier: Apache-2.0
#include "control/io/cia402_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace indurop::io {
namespace {

constexpr double kStandingDegrees = 0.05;  // per second
constexpr double kArrivedDegrees = 0.01;
constexpr double kQuickStopShare = 0.8;  // of the torque, so that the loops have a reserve

constexpr double kPerMille = 1000;

template <class T>
T saturated(double value) noexcept {
  constexpr auto kLow = static_cast<double>(std::numeric_limits<T>::min());
  constexpr auto kHigh = static_cast<double>(std::numeric_limits<T>::max());
  return static_cast<T>(std::clamp(std::nearbyint(value), kLow, kHigh));
}

// Wraps around like a 32-bit register.
std::int32_t wrapped(std::int64_t counts) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(static_cast<std::uint64_t>(counts)));
}

}  // namespace

Cia402Drive::Cia402Drive(const config::IoAxis& axis) noexcept
    : axis_(axis),
      model_(axis),
      homing_(axis_),
      last_(model_.position()),
      previous_(model_.position()),
      last_counts_(model_.read_encoder()) {
  start_over();
}

double Cia402Drive::radians_of(std::int32_t counts) const noexcept {
  // The turn nearest to the actual position.
  const std::int64_t shown = last_counts_ - zero_counts_;
  const auto difference =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(counts) - static_cast<std::uint32_t>(wrapped(shown)));
  return static_cast<double>(last_counts_ + difference) / model_.counts_per_radian();
}

bool Cia402Drive::standing() const noexcept {
  return profile_.velocity == 0 && std::fabs(model_.velocity()) < kStandingDegrees * kRadiansPerDegree;
}

double Cia402Drive::degrees() const noexcept {
  return model_.position() / kRadiansPerDegree;
}

void Cia402Drive::follow_actual() noexcept {
  profile_ = {model_.position(), model_.velocity()};
}

void Cia402Drive::start_over() noexcept {
  follow_actual();
  target_ = model_.position();
  next_target_.reset();
  reached_ = false;
  home_ = Home::Idle;
  homing_.forget();
  torque_ = 0;
  following_error_s_ = 0;
}

void Cia402Drive::take_mode(std::int8_t mode) noexcept {
  const auto wanted = static_cast<DriveMode>(mode);
  switch (wanted) {
    case DriveMode::None:
    case DriveMode::ProfilePosition:
    case DriveMode::ProfileVelocity:
    case DriveMode::ProfileTorque:
    case DriveMode::Homing:
    case DriveMode::InterpolatedPosition:
    case DriveMode::CyclicPosition:
    case DriveMode::CyclicVelocity:
    case DriveMode::CyclicTorque:
      if (mode_ != wanted) {
        mode_ = wanted;
        start_over();
      }
      return;
  }
}

void Cia402Drive::take_set_point(const DriveCommand& command) noexcept {
  const bool rising = (command.control & kNewSetPoint) != 0 && (last_control_ & kNewSetPoint) == 0;
  const bool falling = (command.control & kNewSetPoint) == 0 && (last_control_ & kNewSetPoint) != 0;
  if (mode_ == DriveMode::Homing) {
    if (rising) {
      home_ = Home::Moving;
      homing_.start();
      reached_ = false;
    } else if (falling && home_ == Home::Moving) {
      home_ = Home::Idle;
      homing_.forget();
    }
    return;
  }
  if (mode_ != DriveMode::ProfilePosition || !rising) {
    return;
  }
  const bool relative = (command.control & kRelative) != 0;
  const double wanted = relative ? next_target_.value_or(target_) + command.position / model_.counts_per_radian()
                                 : radians_of(command.position);
  if (reached_ || (command.control & kChangeAtOnce) != 0 || standing()) {
    target_ = wanted;
    next_target_.reset();
    reached_ = false;
  } else {
    next_target_ = wanted;
  }
}

void Cia402Drive::advance_profile_position(const DriveCommand& command, double dt) noexcept {
  const double acceleration = axis_.acceleration * kRadiansPerDegree;
  if ((command.control & kHalt) != 0) {
    reached_ = profile_.change_velocity(0, acceleration, dt);
    return;
  }
  const bool there = profile_.go_to(target_, model_.max_velocity(), acceleration, dt);
  reached_ = there && std::fabs(model_.position() - target_) < kArrivedDegrees * kRadiansPerDegree;
  if (reached_ && next_target_) {
    target_ = *next_target_;
    next_target_.reset();
    reached_ = false;
  }
}

void Cia402Drive::go_straight_home(double dt) noexcept {
  const double mark = axis_.mark * kRadiansPerDegree;
  const double speed = std::min(axis_.home_speed * kRadiansPerDegree, model_.max_velocity());
  const bool there = profile_.go_to(mark, speed, axis_.acceleration * kRadiansPerDegree, dt);
  if (there && std::fabs(model_.position() - mark) < kArrivedDegrees * kRadiansPerDegree) {
    home_ = Home::Done;
    reached_ = true;
    zero_counts_ = std::llround(mark * model_.counts_per_radian());
  }
}

void Cia402Drive::advance_homing(const DriveCommand& command, double dt) noexcept {
  const double acceleration = axis_.acceleration * kRadiansPerDegree;
  if (home_ != Home::Moving || (command.control & kHalt) != 0) {
    reached_ = profile_.change_velocity(0, acceleration, dt);
    return;
  }
  if (!axis_.homing) {
    go_straight_home(dt);
    return;
  }
  const double wanted = homing_.step(previous_ / kRadiansPerDegree, last_ / kRadiansPerDegree);
  const double limit = model_.max_velocity();
  profile_.change_velocity(std::clamp(wanted * kRadiansPerDegree, -limit, limit), acceleration, dt);
  if (homing_.state() == Homing::State::Done) {
    home_ = Home::Done;
    zero_counts_ = std::llround(homing_.home() * kRadiansPerDegree * model_.counts_per_radian());
  } else if (homing_.state() == Homing::State::Failed) {
    home_ = Home::Idle;
  }
}

void Cia402Drive::advance_torque(const DriveCommand& command, double dt) noexcept {
  const double wanted = command.torque / kPerMille * axis_.torque;
  if (mode_ == DriveMode::CyclicTorque) {
    torque_ = wanted + command.torque_offset / kPerMille * axis_.torque;
    return;
  }
  const double target = (command.control & kHalt) != 0 ? 0 : wanted;
  const double step = axis_.torque_slope / kPerMille * axis_.torque * dt;
  torque_ += std::clamp(target - torque_, -step, step);
  reached_ = torque_ == target;
}

// Beyond a limit switch only motion back is allowed.
void Cia402Drive::stop_at_limits(const AxisProfile& before, double dt) noexcept {
  if (!axis_.low_limit && !axis_.high_limit) {
    return;
  }
  const AxisSwitches now = switches_at(axis_, degrees());
  const double towards = is_torque(mode_) ? torque_ : profile_.velocity;
  const bool was_at_limit = at_limit_;
  at_limit_ = mode_ != DriveMode::Homing && ((now.high && towards > 0) || (now.low && towards < 0));
  if (at_limit_) {
    profile_ = was_at_limit || !is_torque(mode_) ? before : AxisProfile{model_.position(), model_.velocity()};
    profile_.change_velocity(0, kQuickStopShare * model_.max_deceleration(), dt);
  }
}

void Cia402Drive::close_loops(const DriveCommand& command) noexcept {
  if (is_torque(mode_) && !at_limit_) {
    model_.push(torque_);
    return;
  }
  const bool adds = is_cyclic(mode_) && !at_limit_;
  const double velocity = adds ? command.velocity_offset / model_.counts_per_radian() : 0;
  const double torque = adds ? command.torque_offset / kPerMille * axis_.torque : 0;
  model_.drive({profile_.position, profile_.velocity + velocity, follows_position_, torque});
}

void Cia402Drive::advance_enabled(const DriveCommand& command, double dt) noexcept {
  const double acceleration = axis_.acceleration * kRadiansPerDegree;
  const bool halt = (command.control & kHalt) != 0;
  const double limit = model_.max_velocity();
  const double velocity = std::clamp(command.velocity / model_.counts_per_radian(), -limit, limit);
  switch (mode_) {
    case DriveMode::None:
      profile_.change_velocity(0, acceleration, dt);
      break;
    case DriveMode::ProfilePosition:
      advance_profile_position(command, dt);
      break;
    case DriveMode::ProfileVelocity:
      reached_ = profile_.change_velocity(halt ? 0 : velocity, acceleration, dt);
      break;
    case DriveMode::Homing:
      advance_homing(command, dt);
      break;
    case DriveMode::InterpolatedPosition:
    case DriveMode::CyclicPosition:
      profile_.velocity = cyclic_velocity_;
      profile_.position += cyclic_velocity_ * dt;
      break;
    case DriveMode::CyclicVelocity:
      profile_ = {model_.position(), halt ? 0 : velocity};
      break;
    case DriveMode::ProfileTorque:
    case DriveMode::CyclicTorque:
      advance_torque(command, dt);
      profile_ = {model_.position(), model_.velocity()};
      break;
  }
}

void Cia402Drive::watch_following(double dt) noexcept {
  const double error = std::fabs(profile_.position - model_.position());
  if (!follows_position_ || error <= axis_.following * kRadiansPerDegree) {
    following_error_s_ = 0;
    return;
  }
  following_error_s_ += dt;
  if (following_error_s_ > std::chrono::duration<double>(axis_.following_time).count()) {
    machine_.fail(kFollowingError);
    follow_actual();
  }
}

void Cia402Drive::advance(const DriveCommand& command, double dt) noexcept {
  switch (machine_.state()) {
    case DriveState::OperationEnabled: {
      const AxisProfile before = profile_;
      advance_enabled(command, dt);
      stop_at_limits(before, dt);
      follows_position_ = is_position(mode_) || mode_ == DriveMode::Homing;
      close_loops(command);
      watch_following(dt);
      break;
    }
    case DriveState::QuickStopActive:
    case DriveState::FaultReaction:
      profile_.change_velocity(0, kQuickStopShare * model_.max_deceleration(), dt);
      model_.drive({profile_.position, profile_.velocity, true, 0});
      break;
    case DriveState::NotReady:
    case DriveState::SwitchOnDisabled:
    case DriveState::ReadyToSwitchOn:
    case DriveState::SwitchedOn:
    case DriveState::Fault:
      model_.brake();
      profile_ = {model_.position(), 0};
      break;
  }
}

std::uint16_t Cia402Drive::mode_bits(const DriveCommand& command) const noexcept {
  unsigned bits = reached_ ? kTargetReached : 0U;
  switch (mode_) {
    case DriveMode::None:
      return 0;
    case DriveMode::ProfilePosition:
      bits |= (command.control & kNewSetPoint) != 0 || next_target_ ? kModeBit12 : 0U;
      bits |= following_error_s_ > 0 ? kModeBit13 : 0U;
      break;
    case DriveMode::ProfileVelocity:
      bits |= standing() ? kModeBit12 : 0U;
      break;
    case DriveMode::ProfileTorque:
      break;
    case DriveMode::Homing:
      bits |= home_ == Home::Done ? kModeBit12 : 0U;
      bits |= homing_.state() == Homing::State::Failed ? kModeBit13 : 0U;
      break;
    case DriveMode::InterpolatedPosition:
      bits = (command.control & kNewSetPoint) != 0 ? kModeBit12 : 0U;
      break;
    case DriveMode::CyclicPosition:
      bits = kModeBit12 | (following_error_s_ > 0 ? kModeBit13 : 0U);
      break;
    case DriveMode::CyclicVelocity:
    case DriveMode::CyclicTorque:
      bits = kModeBit12;
      break;
  }
  return static_cast<std::uint16_t>(bits);
}

DriveFeedback Cia402Drive::feedback(const DriveCommand& command) noexcept {
  last_counts_ = model_.read_encoder();
  DriveFeedback result;
  unsigned status = machine_.status() | kVoltage | kRemote;
  if (machine_.state() == DriveState::OperationEnabled) {
    status |= mode_bits(command) | (model_.limited() || at_limit_ ? kLimitActive : 0U);
  }
  result.status = static_cast<std::uint16_t>(status);
  result.error = machine_.error();
  result.mode = static_cast<std::int8_t>(mode_);
  result.position = wrapped(last_counts_ - zero_counts_);
  result.velocity = saturated<std::int32_t>(model_.velocity() * model_.counts_per_radian());
  result.torque = saturated<std::int16_t>(model_.take_mean_torque() / axis_.torque * kPerMille);
  result.following = follows_position_
                         ? saturated<std::int32_t>((profile_.position - model_.position()) * model_.counts_per_radian())
                         : 0;
  report_sensors(result);
  return result;
}

std::int32_t Cia402Drive::shown(double degrees) const noexcept {
  return wrapped(std::llround(degrees * kRadiansPerDegree * model_.counts_per_radian()) - zero_counts_);
}

void Cia402Drive::report_sensors(DriveFeedback& result) const noexcept {
  constexpr unsigned kProbeInput = 16;
  constexpr unsigned kSecond = 8;
  const AxisSwitches switches = switches_at(axis_, degrees());
  const auto is_on = [this](const std::optional<double>& at) { return at && degrees() >= *at; };
  result.inputs = (switches.low ? 1U : 0U) | (switches.high ? 2U : 0U) | (switches.home ? 4U : 0U) |
                  (is_on(axis_.probe) ? 1U << kProbeInput : 0U) | (is_on(axis_.probe2) ? 2U << kProbeInput : 0U);
  result.probe = static_cast<std::uint16_t>(probe_.status() | static_cast<unsigned>(probe2_.status()) << kSecond);
  if (result.probe != 0) {
    result.probe_rise = shown(probe_.rise());
    result.probe_fall = shown(probe_.fall());
    result.probe2_rise = shown(probe2_.rise());
    result.probe2_fall = shown(probe2_.fall());
  }
}

double Cia402Drive::cyclic_target(const DriveCommand& command) const noexcept {
  if (mode_ == DriveMode::InterpolatedPosition) {
    return (command.control & kNewSetPoint) != 0 ? radians_of(command.position) : profile_.position;
  }
  return radians_of(wrapped(std::int64_t{command.position} + command.position_offset));
}

DriveFeedback Cia402Drive::step(const DriveCommand& command, std::chrono::nanoseconds elapsed) noexcept {
  const double period = std::chrono::duration<double>(elapsed).count();
  machine_.step(command.control, standing());
  if (was_enabled_ && machine_.state() == DriveState::QuickStopActive) {
    follow_actual();
  }
  take_mode(command.mode);
  const bool enabled = machine_.state() == DriveState::OperationEnabled;
  if (enabled && !was_enabled_) {
    start_over();
  }
  was_enabled_ = enabled;
  if (enabled) {
    take_set_point(command);
  }
  last_control_ = command.control;
  constexpr unsigned kSecond = 8;
  probe_.take(static_cast<std::uint8_t>(command.probe));
  probe2_.take(static_cast<std::uint8_t>(command.probe >> kSecond));
  if ((mode_ == DriveMode::CyclicPosition || mode_ == DriveMode::InterpolatedPosition) && period > 0) {
    cyclic_velocity_ = enabled ? (cyclic_target(command) - profile_.position) / period : 0;
  }
  model_.carry(command.load);
  // Equal steps, none longer than those of the loops.
  const std::int64_t steps = (elapsed.count() + AxisModel::kStepNs - 1) / AxisModel::kStepNs;
  const double dt =
      steps > 0 ? static_cast<double>(elapsed.count()) / static_cast<double>(steps) / 1e9 : AxisModel::kStep;
  model_.set_step(dt);
  for (std::int64_t i = 0; i < steps; ++i) {
    advance(command, dt);
    previous_ = std::exchange(last_, model_.position());
    if (command.probe != 0) {
      probe_.step({previous_ / kRadiansPerDegree, degrees(), axis_.probe, axis_.mark});
      probe2_.step({previous_ / kRadiansPerDegree, degrees(), axis_.probe2, axis_.mark});
    }
  }
  return feedback(command);
}

}  // namespace indurop::io
