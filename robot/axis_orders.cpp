// SPDX-License-Identifier: Apache-2.0
// What single axes are asked to do, one thing after the other: which command ends which, and what each of them means as
// a motion.

#include <algorithm>
#include <cmath>

#include "robot/axis_control.h"

namespace indurop::robot {

namespace {

bool follows(AxisService service) noexcept {
  return service == AxisService::GearIn || service == AxisService::CamIn || service == AxisService::GearInPos ||
         service == AxisService::Combine;
}

// deg/s, deg/s^2, deg/s^3 or mm: what is asked for, if it is neither 0 (as much as there is) nor something.
bool nothing(double value) noexcept {
  return value != 0 && std::abs(value) < 1e-6;
}

bool sane(double part) noexcept {
  return part > 0 && part <= 1;
}

bool is_relative(AxisService service) noexcept {
  return service == AxisService::MoveRelative || service == AxisService::MoveAdditive;
}

}  // namespace

AxisService AxisControl::service_of(const Command& command) noexcept {
  return static_cast<AxisService>(command.code);
}

bool AxisControl::is_move(AxisService service) noexcept {
  return service == AxisService::MoveAbsolute || is_relative(service);
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
                      service == AxisService::AbortTrigger;
  if (permit != ErrorCode::Ok && !always) {
    table_->end(ticket, permit);
    return;
  }
  report_.error = state_ == AxisState::ErrorStop ? report_.error : ErrorCode::Ok;
  order(ticket, command);
}

void AxisControl::order(int ticket, const Command& command) noexcept {
  const AxisService service = service_of(command);
  Owner owner{ticket, service};
  switch (service) {
    case AxisService::None:
      finish(owner, ErrorCode::Ok);
      break;
    case AxisService::PowerOn:
    case AxisService::PowerOff:
    case AxisService::Reset:
      administer(ticket, service);
      break;
    case AxisService::SetPosition:
      set_position(ticket, command);
      break;
    case AxisService::Stop:
      stop_for(ticket, command);
      break;
    case AxisService::Home:
    case AxisService::Halt:
    case AxisService::MoveAbsolute:
    case AxisService::MoveRelative:
    case AxisService::MoveAdditive:
    case AxisService::MoveVelocity:
    case AxisService::GearIn:
    case AxisService::CamIn:
    case AxisService::GearInPos:
    case AxisService::Combine:
      queue(ticket, command);
      break;
    case AxisService::ShiftMaster:
      shift_master(ticket, command);
      break;
    case AxisService::Decouple:
      decouple(ticket);
      break;
    case AxisService::MoveSuperimposed:
      superimpose(ticket, command);
      break;
    case AxisService::HaltSuperimposed:
      halt_superimposed(ticket, command);
      break;
    case AxisService::TouchProbe:
      begin_probe(ticket, command);
      break;
    case AxisService::AbortTrigger:
      abort_probe(ticket);
      break;
    default:
      finish(owner, ErrorCode::Opcode);
  }
}

void AxisControl::administer(int ticket, AxisService service) noexcept {
  finish(admin_, ErrorCode::Aborted);
  admin_ = {ticket, service};
  waited_ = 0;
  if (ticket != kRequest) {
    table_->active(ticket);
  }
  switch (service) {
    case AxisService::PowerOn:
      letting_go_ = drive_.enabled() && !want_power_;
      state_ == AxisState::ErrorStop ? finish(admin_, ErrorCode::State) : void(want_power_ = !letting_go_);
      break;
    case AxisService::PowerOff:
      release_stop();
      halt();
      break;
    default:
      if (state_ != AxisState::ErrorStop && !drive_.faulty()) {
        finish(admin_, ErrorCode::Ok);  // there is nothing to reset
      }
  }
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

// Where it is gets another name; nothing moves, and a motion keeps its target.
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

// What can be said before its turn comes.
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
  const ErrorCode code = resolve(command, adds ? motion_.target() : commanded().position, order);
  return waits && code != ErrorCode::Value ? ErrorCode::Ok : code;  // where it begins is not known yet
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
    // What a target is added to is that of the motion before.
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

// The target in the turn that the direction says.
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
  order.limits = {chosen(speed, most_.velocity), harder * chosen(command.acceleration, most_.acceleration),
                  jerk_factor_ * chosen(command.jerk, most_.jerk)};
  order.braking = {order.limits.velocity, harder * chosen(slowing, most_.acceleration), order.limits.jerk};
  if (service == AxisService::Stop) {
    order.braking = {most_.velocity, chosen(slowing, most_.acceleration), chosen(command.jerk, most_.jerk)};
  }
  if (to_velocity) {
    const bool back = command.direction == Direction::Negative ||
                      (command.direction == Direction::Current && motion_.state().velocity < 0);
    const bool negative = (command.velocity < 0) != back;
    order.target = negative ? -order.limits.velocity : order.limits.velocity;
  }
  if (follows(service)) {
    Coupled way;
    return resolve(command, order, way);
  }
  if (!is_move(service)) {
    return ErrorCode::Ok;
  }
  if (service == AxisService::MoveAbsolute && !homed_) {
    return ErrorCode::NotHomed;
  }
  const double asked = command.to[0] * scale_.unit;
  order.target = is_relative(service) ? from + asked : turned(asked + origin_, from, command.direction);
  const bool inside = endless_ || (order.target >= lower_ - 1e-9 && order.target <= upper_ + 1e-9);
  return inside ? ErrorCode::Ok : ErrorCode::JointLimit;
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
  if (service == AxisService::Home && (state_ == AxisState::ContinuousMotion || !motion_.at_rest())) {
    code = ErrorCode::State;
  }
  if (code != ErrorCode::Ok) {
    // It had to stand; what was to follow may lead anywhere from here.
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
  if (follows(service)) {
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
    default:
      motion_.move_to(order.target, order.limits, order.braking);
      state_ = AxisState::DiscreteMotion;
  }
}

// The motion on its way has ended; the next one begins where it is.
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

// What blocks change of commands that they have given.
void AxisControl::look_at_commands() noexcept {
  const int ticket = motion_owner_.ticket;
  if (ticket != kNobody && ticket != kRequest && table_->updated(ticket)) {
    const Command& command = table_->command(ticket);
    Order order;
    if (const ErrorCode code = resolve(command, began_at_, order); code != ErrorCode::Ok) {
      abort_queue();
      finish(motion_owner_, code);
      let_go();
      motion_.stop(limits(1));
      state_ = AxisState::Stopping;
    } else if (motion_owner_.service != AxisService::Home) {
      begin_motion(command, order);
      choose_passing();
    }
  }
}

void AxisControl::release_stop() noexcept {
  if (stop_ != kNobody) {
    table_->end(stop_, motion_.at_rest() && drive_.enabled() ? ErrorCode::Ok : ErrorCode::Aborted);
    stop_ = kNobody;
  }
}

}  // namespace indurop::robot
