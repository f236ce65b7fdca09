// SPDX-License-Identifier: Apache-2.0
// A motion superimposed on the motion of a single axis: its own motion, following another axis, or standstill. The sum
// keeps the limits of the axis: what they do not allow at once comes later.

#include <algorithm>
#include <cmath>

#include "control/robot/axis/control.h"

namespace indurop::robot {

namespace {

constexpr double kMostShift = 1e6;  // deg or mm

}  // namespace

ErrorCode AxisControl::check_superimposed(const Command& command) const noexcept {
  const bool moves = state_ == AxisState::Standstill || state_ == AxisState::DiscreteMotion ||
                     state_ == AxisState::ContinuousMotion || coupled_;
  const bool catches_up = coupled_ && super_.ticket == kNobody && !coupling_.synced();
  const bool shifts = super_.service == AxisService::ShiftMaster;
  if (!drive_.enabled() || !moves || push_.on() || leaving_ || catches_up || shifts || queued_ > 0) {
    return ErrorCode::State;
  }
  if (coupled_ || state_ == AxisState::ContinuousMotion || endless_) {
    return ErrorCode::Ok;
  }
  // Position after both motions have ended.
  const double own = is_move(motion_owner_.service) ? motion_.target() - motion_.state().position : 0;
  const double end = commanded().position + own + command.to[0] * scale_.unit;
  return end >= lower_ - 1e-9 && end <= upper_ + 1e-9 ? ErrorCode::Ok : ErrorCode::JointLimit;
}

void AxisControl::superimpose(int ticket, const Command& command) noexcept {
  Owner owner{ticket, AxisService::MoveSuperimposed};
  Order order;
  ErrorCode code = resolve(command, 0, order);
  code = code == ErrorCode::Ok ? check_superimposed(command) : code;
  if (code != ErrorCode::Ok) {
    finish(owner, code);
    return;
  }
  finish(super_, ErrorCode::Aborted);
  LineLimits limits = order.limits;
  limits.acceleration = std::min(limits.acceleration, order.braking.acceleration);
  if (!coupled_ && !over_) {
    coupling_.engage({}, limits, most_, motion_.state());
    over_ = true;
  }
  coupling_.shift(command.to[0] * scale_.unit, limits);
  super_ = owner;
  state_ = state_ == AxisState::Standstill ? AxisState::DiscreteMotion : state_;
  if (ticket != kRequest) {
    table_->active(ticket);
  }
}

void AxisControl::halt_superimposed(int ticket, const Command& command) noexcept {
  Owner owner{ticket, AxisService::HaltSuperimposed};
  Order order;
  const ErrorCode code = resolve(command, 0, order);
  if (code != ErrorCode::Ok || super_.ticket == kNobody || super_.service == AxisService::ShiftMaster) {
    finish(owner, code != ErrorCode::Ok ? code : ErrorCode::State);
    return;
  }
  finish(super_, ErrorCode::Aborted);
  super_ = owner;
  coupling_.stop_shift(order.braking);
  if (ticket != kRequest) {
    table_->active(ticket);
  }
}

ErrorCode AxisControl::check_shift(const Command& command) const noexcept {
  const bool on_top = super_.ticket != kNobody && super_.service != AxisService::ShiftMaster;
  if (!drive_.enabled() || !coupled_ || on_top || (super_.ticket == kNobody && !coupling_.synced())) {
    return ErrorCode::State;
  }
  const bool one_master = leading_ == 1 && command.option == leaders_[0].axis + 1;
  const bool sane = std::abs(command.to[0]) <= kMostShift && command.buffer == BufferMode::Aborting;
  return one_master && sane ? ErrorCode::Ok : ErrorCode::Value;
}

// Shifts the master's position as seen by the follower; the master is not affected.
void AxisControl::shift_master(int ticket, const Command& command) noexcept {
  Owner owner{ticket, AxisService::ShiftMaster};
  Order order;
  ErrorCode code = resolve(command, 0, order);
  code = code == ErrorCode::Ok ? check_shift(command) : code;
  if (code != ErrorCode::Ok) {
    finish(owner, code);
    return;
  }
  finish(super_, ErrorCode::Aborted);
  const AxisControl& master = row_.axes[static_cast<std::size_t>(leaders_[0].axis)];
  const double unit = master.scale_.unit;
  const auto chosen = [unit](double wanted, double most) { return wanted == 0 ? most : std::min(wanted * unit, most); };
  const double slowing = command.deceleration == 0 ? command.acceleration : command.deceleration;
  const LineLimits limits{
      chosen(command.velocity, master.most_.velocity),
      std::min(chosen(command.acceleration, master.most_.acceleration), chosen(slowing, master.most_.acceleration)),
      chosen(command.jerk, master.most_.jerk)};
  coupling_.shift_master((command.job == 1 ? coupling_.phase() : 0) + command.to[0] * unit, limits);
  super_ = owner;
  if (ticket != kRequest) {
    table_->active(ticket);
  }
}

// Adds to the axis' own motion, which has already advanced by this period.
void AxisControl::advance_over(double seconds) noexcept {
  const SetPointGate& gate = row_.gates[static_cast<std::size_t>(row_.own)];
  const ErrorCode code = coupling_.step({gate.state(), motion_.state().position}, gate, seconds);
  if (code != ErrorCode::Ok) {
    finish(super_, code);
    fail_coupling(code);
  }
}

// The superimposed motion has ended; if nothing moves any more, the axis rests where both have led.
void AxisControl::note_superimposed() noexcept {
  if (super_.ticket != kNobody && coupling_.synced()) {
    finish(super_, ErrorCode::Ok);
  }
  if (!over_ || state_ != AxisState::DiscreteMotion || !motion_.at_rest()) {
    return;
  }
  if (motion_owner_.ticket != kNobody) {
    end_motion(ErrorCode::Ok);
  }
  if (coupling_.synced()) {
    over_ = false;
    motion_.reset({coupling_.state().position, 0, 0});
    state_ = AxisState::Standstill;
  }
}

}  // namespace indurop::robot
