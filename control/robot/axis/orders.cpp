// SPDX-License-Identifier: Apache-2.0
// Commands of single axes in their order: which command ends which, and how each of them becomes a motion.

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "control/robot/axis/control.h"

namespace indurop::robot {

namespace {

bool sane(double part) noexcept {
  return part > 0 && part <= 1;
}

}  // namespace

AxisService AxisControl::service_of(const Command& command) noexcept {
  return static_cast<AxisService>(command.code);
}

void AxisControl::set_factors(double acceleration, double jerk) noexcept {
  acceleration_factor_ = sane(acceleration) ? acceleration : 1;
  jerk_factor_ = sane(jerk) ? jerk : 1;
}

void AxisControl::take(int ticket, ErrorCode permit) noexcept {
  const Command& command = table_->command(ticket);
  const AxisService service = service_of(command);
  const bool always = service == AxisService::Reset || service == AxisService::PowerOn ||
                      service == AxisService::SetPosition || service == AxisService::TouchProbe ||
                      service == AxisService::AbortTrigger || service == AxisService::WriteParameter;
  if (permit != ErrorCode::Ok && !always) {
    table_->end(ticket, permit);
    return;
  }
  report_.error = state_ == AxisState::ErrorStop ? report_.error : ErrorCode::Ok;
  order(ticket, command);
}

void AxisControl::order(int ticket, const Command& command) noexcept {
  // Handler of each service.
  static constexpr auto kBy = [] {
    using enum AxisService;
    std::array<void (AxisControl::*)(int, const Command&) noexcept, kServices> by{};
    const auto set = [&by](auto handler, std::initializer_list<AxisService> services) {
      for (const AxisService service : services) {
        by[static_cast<std::size_t>(service)] = handler;
      }
    };
    set(&AxisControl::ignore, {None});
    set(&AxisControl::administer, {PowerOn, PowerOff, Reset});
    set(&AxisControl::queue, {Home, Halt, MoveAbsolute, MoveRelative, MoveAdditive, MoveVelocity});
    set(&AxisControl::queue, {MoveContinuousAbsolute, MoveContinuousRelative, GearIn, CamIn, GearInPos, Combine});
    set(&AxisControl::queue, {PositionProfile, VelocityProfile, AccelerationProfile, AxisService::TorqueControl});
    set(&AxisControl::stop_for, {Stop});
    set(&AxisControl::set_position, {SetPosition});
    set(&AxisControl::write_parameter, {WriteParameter});
    set(&AxisControl::shift_master, {ShiftMaster});
    set(&AxisControl::decouple, {Decouple});
    set(&AxisControl::superimpose, {MoveSuperimposed});
    set(&AxisControl::halt_superimposed, {HaltSuperimposed});
    set(&AxisControl::begin_probe, {TouchProbe});
    set(&AxisControl::abort_probe, {AbortTrigger});
    return by;
  }();
  const auto code = static_cast<std::size_t>(command.code);
  if (code < kBy.size() && kBy[code] != nullptr) {
    (this->*kBy[code])(ticket, command);
  } else {
    Owner owner{ticket, AxisService::None};
    finish(owner, ErrorCode::Opcode);
  }
}

void AxisControl::ignore(int ticket, const Command& /*command*/) noexcept {
  Owner owner{ticket, AxisService::None};
  finish(owner, ErrorCode::Ok);
}

void AxisControl::stop_for(int ticket, const Command& command) noexcept {
  Owner owner{ticket, AxisService::Stop};
  Order how;
  const ErrorCode code = resolve(command, motion_.state().position, how);
  if (code != ErrorCode::Ok || !drive_.enabled() || state_ == AxisState::ErrorStop) {
    finish(owner, code != ErrorCode::Ok ? code : ErrorCode::State);
    return;
  }
  release_stop();
  halt();
  motion_.stop(how.braking);
  state_ = AxisState::Stopping;
  if (ticket == kRequest) {
    motion_owner_ = owner;
  } else {
    stop_ = ticket;
    table_->active(ticket);
  }
}

void AxisControl::halt() noexcept {
  abort_queue();
  finish(motion_owner_, ErrorCode::Aborted);
  if (state_ == AxisState::Homing) {
    drive_.home(false);
    motion_.reset({measured_, 0, 0});
  }
  if (busy()) {
    let_go();
    motion_.stop(limits(1));
    state_ = AxisState::Stopping;
  }
}

// Gives the present position a new value; nothing moves, and a motion keeps its target.
void AxisControl::set_position(int ticket, const Command& command) noexcept {
  Owner owner{ticket, AxisService::SetPosition};
  const double wanted = command.to[0] * scale_.unit;
  if (!std::isfinite(wanted)) {
    finish(owner, ErrorCode::Value);
    return;
  }
  if (state_ == AxisState::Homing) {
    finish(owner, ErrorCode::State);
    return;
  }
  origin_ = command.option == 1 ? origin_ - wanted : commanded().position - wanted;
  finish(owner, ErrorCode::Ok);
}

// Checks what can be checked before the command begins.
ErrorCode AxisControl::check(const Command& command) const noexcept {
  const AxisService service = service_of(command);
  if (!drive_.enabled() || state_ == AxisState::ErrorStop || state_ == AxisState::Stopping) {
    return ErrorCode::State;
  }
  const bool waits = command.buffer != BufferMode::Aborting;
  if (command.buffer < BufferMode::Aborting || command.buffer > BufferMode::BlendingHigh) {
    return ErrorCode::Value;
  }
  if ((state_ == AxisState::Homing && !waits) || (over_ && waits)) {
    return ErrorCode::State;
  }
  if (service == AxisService::Home) {
    return waits || state_ == AxisState::Standstill ? ErrorCode::Ok : ErrorCode::State;
  }
  Order order;
  const bool adds = service == AxisService::MoveAdditive && is_move(motion_owner_.service);
  ErrorCode code = resolve(command, adds ? motion_.target() : commanded().position, order);
  code = code == ErrorCode::Ok ? check_way(command, order) : code;
  return waits && code != ErrorCode::Value ? ErrorCode::Ok : code;  // its start is not known yet
}

void AxisControl::queue(int ticket, const Command& command) noexcept {
  if (const ErrorCode code = check(command); code != ErrorCode::Ok) {
    Owner owner{ticket, service_of(command)};
    finish(owner, code);
    return;
  }
  const bool moves = motion_owner_.ticket != kNobody;
  if (ticket == kRequest || command.buffer == BufferMode::Aborting) {
    abort_queue();
    // An additive target is added to the target of the previous motion.
    added_to_ = is_move(motion_owner_.service) ? motion_.target() : motion_.state().position;
    finish(motion_owner_, ErrorCode::Aborted);
    begin(ticket, command);
  } else if (!moves && queued_ == 0) {
    added_to_ = motion_.state().position;
    begin(ticket, command);
  } else {
    queue_[static_cast<std::size_t>(queued_++)] = ticket;
    choose_passing();
  }
}

void AxisControl::abort_queue() noexcept {
  for (int i = 0; i < queued_; ++i) {
    table_->end(queue_[static_cast<std::size_t>(i)], ErrorCode::Aborted);
  }
  queued_ = 0;
}

void AxisControl::begin(int ticket, const Command& command) noexcept {
  const AxisService service = service_of(command);
  Owner owner{ticket, service};
  Order order;
  if (over_) {
    let_go();
  }
  began_at_ = service == AxisService::MoveAdditive ? added_to_ : motion_.state().position;
  ErrorCode code = resolve(command, began_at_, order);
  code = code == ErrorCode::Ok ? check_way(command, order) : code;
  if (service == AxisService::Home && (state_ == AxisState::ContinuousMotion || !motion_.at_rest())) {
    code = ErrorCode::State;
  }
  if (code != ErrorCode::Ok) {
    // It had to be at rest; queued motions might lead anywhere from here.
    abort_queue();
    finish(owner, code);
    motion_.stop(limits(1));
    state_ = busy() ? AxisState::Stopping : state_;
    let_go();
    return;
  }
  motion_owner_ = owner;
  if (ticket != kRequest) {
    table_->active(ticket);
  }
  begin_motion(command, order);
  choose_passing();
}

void AxisControl::begin_motion(const Command& command, const Order& order) noexcept {
  const AxisService service = service_of(command);
  if (service == AxisService::TorqueControl) {
    begin_torque(order);
    return;
  }
  if (follows(service)) {
    leave_torque();
    couple(command, order);
    return;
  }
  let_go();
  switch (service) {
    case AxisService::Home:
      home();
      break;
    case AxisService::Halt:
      motion_.stop(order.braking);
      state_ = AxisState::DiscreteMotion;
      break;
    case AxisService::MoveVelocity: {
      const bool slower = std::abs(order.target) < std::abs(motion_.state().velocity);
      motion_.move_with(order.target, slower ? order.braking : order.limits);
      state_ = AxisState::ContinuousMotion;
      break;
    }
    case AxisService::MoveContinuousAbsolute:
    case AxisService::MoveContinuousRelative:
      motion_.move_through(order.target, order.end, order.limits, order.braking);
      state_ = AxisState::ContinuousMotion;
      break;
    case AxisService::PositionProfile:
    case AxisService::VelocityProfile:
    case AxisService::AccelerationProfile:
      begin_profile(command);
      break;
    default:
      motion_.move_to(order.target, order.limits, order.braking);
      state_ = AxisState::DiscreteMotion;
  }
}

// The motion in progress has ended; the next one begins where it ended.
void AxisControl::end_motion(ErrorCode code) noexcept {
  added_to_ = motion_.state().position;
  finish(motion_owner_, code);
  begin_next();
}

void AxisControl::begin_next() noexcept {
  if (queued_ == 0) {
    if (motion_.passed()) {
      motion_.stop(limits(1));
    }
    return;
  }
  const int ticket = queue_[0];
  std::copy(queue_.begin() + 1, queue_.begin() + queued_, queue_.begin());
  --queued_;
  begin(ticket, table_->command(ticket));
}

// Blocks may change commands that they have issued.
void AxisControl::look_at_commands() noexcept {
  const int ticket = motion_owner_.ticket;
  if (ticket == kNobody || ticket == kRequest || !table_->updated(ticket) || is_profile(motion_owner_.service)) {
    return;
  }
  const Command& command = table_->command(ticket);
  Order order;
  ErrorCode code = resolve(command, began_at_, order);
  const bool gone = goes_on_from(motion_owner_.service) && motion_.went_through(order.target);
  code = code == ErrorCode::Ok && !gone ? check_way(command, order) : code;
  if (code != ErrorCode::Ok) {
    abort_queue();
    finish(motion_owner_, code);
    let_go();
    motion_.stop(limits(1));
    state_ = AxisState::Stopping;
  } else if (gone) {
    motion_.go_on_with(order.end, order.limits, order.braking);
  } else if (motion_owner_.service != AxisService::Home) {
    begin_motion(command, order);
    choose_passing();
  }
}

void AxisControl::release_stop() noexcept {
  if (stop_ != kNobody) {
    table_->end(stop_, motion_.at_rest() && drive_.enabled() ? ErrorCode::Ok : ErrorCode::Aborted);
    stop_ = kNobody;
  }
}

}  // namespace indurop::robot
