// SPDX-License-Identifier: Apache-2.0
// Motions of single axes by a time table: conditions for their start, and how they end.

#include <algorithm>
#include <cmath>

#include "control/robot/axis/control.h"

namespace indurop::robot {

void AxisMotion::move_along(const TimeProfile& table, const LineLimits& limits, bool to_rest) noexcept {
  goal_ = Goal::Table;
  table_ = table;
  limits_ = limits;
  rests_ = to_rest;
  went_through_.reset();
  passing_ = passed_ = harder_ = false;
  time_ = 0;
}

void AxisMotion::step_along() noexcept {
  const double left = time_ - table_.duration();
  state_ = table_.at(std::min(time_, table_.duration()));
  if (left < 0) {
    return;
  }
  if (rests_) {
    reset({state_.position, 0, 0});
    return;
  }
  goal_ = Goal::Velocity;
  target_ = unloaded(state_, limits_);
  plan();
  time_ = left;
  state_ = on_profile(left);
}

bool AxisControl::is_profile(AxisService service) noexcept {
  return service == AxisService::PositionProfile || service == AxisService::VelocityProfile ||
         service == AxisService::AccelerationProfile;
}

// Reads a table that begins at the present state of the axis.
ErrorCode AxisControl::read_table(const Command& command, TimeProfile& table) const noexcept {
  const auto number = static_cast<std::size_t>(command.job) - 1;
  if (number >= kProfiles || command.number == 0 || (*row_.profiles)[number].command != command.number) {
    return ErrorCode::Value;
  }
  const LineState& now = motion_.state();
  TimeProfile::Scale scale{command.to[0], command.to[1] * scale_.unit, command.to[2] * scale_.unit};
  auto of = TimeProfile::Of::Acceleration;
  if (service_of(command) == AxisService::VelocityProfile) {
    of = TimeProfile::Of::Velocity;
  } else if (service_of(command) == AxisService::PositionProfile) {
    of = TimeProfile::Of::Position;
    scale.offset += command.option == 1 ? now.position : origin_;
    if (command.option != 1 && !homed_) {
      return ErrorCode::NotHomed;
    }
  }
  return table.set((*row_.profiles)[number], of, scale, now);
}

// Checks the whole path before anything moves.
ErrorCode AxisControl::check_profile(const Command& command) const noexcept {
  constexpr double kRounding = 1e-6;
  TimeProfile table;
  if (const ErrorCode code = read_table(command, table); code != ErrorCode::Ok) {
    return code;
  }
  if (coupled_ || over_ || leaving_ || !motion_.full_speed()) {
    return ErrorCode::State;
  }
  const TimeProfile::Ranges all = table.ranges();
  const double hardest = acceleration_factor_ * std::min(own_.acceleration, own_.deceleration);
  const LineState end = table.at(table.duration());
  if (all.velocity.peak() > own_.velocity * (1 + kRounding) ||
      std::abs(unloaded(end, most_)) > own_.velocity * (1 + kRounding)) {
    return ErrorCode::Speed;
  }
  if (all.acceleration.peak() > hardest * (1 + kRounding)) {
    return ErrorCode::Acceleration;
  }
  if (all.jerk.peak() > jerk_factor_ * own_.jerk * (1 + kRounding)) {
    return ErrorCode::Jerk;
  }
  if (!inside(all.position.least, all.position.greatest)) {
    return ErrorCode::JointLimit;
  }
  const double rest = end.position + ramp(end, 0, limits(1)).distance;
  const bool clear = endless_ || service_of(command) == AxisService::PositionProfile ||
                     (rest >= lower_ + kEndMargin && rest <= upper_ - kEndMargin);
  return clear ? ErrorCode::Ok : ErrorCode::JointLimit;
}

void AxisControl::begin_profile(const Command& command) noexcept {
  TimeProfile table;
  static_cast<void>(read_table(command, table));  // checked before
  const bool to_rest = service_of(command) == AxisService::PositionProfile;
  motion_.move_along(table, {own_.velocity, own_.acceleration, own_.jerk}, to_rest);
  state_ = to_rest ? AxisState::DiscreteMotion : AxisState::ContinuousMotion;
}

// A table is locked to time: an override or a hold ends it.
void AxisControl::guard_table() noexcept {
  if (motion_.along() && !motion_.full_speed()) {
    abort_queue();
    finish(motion_owner_, ErrorCode::State);
    motion_.stop(limits(1));
    state_ = AxisState::Stopping;
  }
}

}  // namespace indurop::robot
