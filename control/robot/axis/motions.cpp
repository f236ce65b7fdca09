// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/motions.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

// Returns the velocity between two motions; 0: the first one comes to rest.
double velocity_of(BufferMode mode, double own, double next) noexcept {
  switch (mode) {
    case BufferMode::BlendingLow:
      return std::min(own, next);
    case BufferMode::BlendingPrevious:
      return own;
    case BufferMode::BlendingNext:
      return next;
    case BufferMode::BlendingHigh:
      return std::max(own, next);
    default:
      return 0;
  }
}

}  // namespace

void AxisMotions::take_stop(int ticket, const Command& command) noexcept {
  AxisOrder how;
  const ErrorCode code = resolver_.resolve(command, parts_.motion.state().position, how);
  if (code != ErrorCode::Ok || !parts_.drive.enabled() || parts_.state == AxisState::ErrorStop) {
    answers_.answer(ticket, AxisService::Stop, code != ErrorCode::Ok ? code : ErrorCode::State);
    return;
  }
  release_stop();
  halt();
  parts_.motion.stop(how.braking);
  parts_.state = AxisState::Stopping;
  if (ticket == AxisOwner::kRequest) {
    owner_ = {ticket, AxisService::Stop};
  } else {
    stop_ = ticket;
    answers_.active(ticket);
  }
}

void AxisMotions::halt() noexcept {
  queue_.abort(answers_.table());
  answers_.finish(owner_, ErrorCode::Aborted);
  if (parts_.state == AxisState::Homing) {
    parts_.drive.home(false);
    parts_.motion.reset({parts_.measured.position, 0, 0});
  }
  if (parts_.busy()) {
    give_back();
    parts_.motion.stop(parts_.bounds.limits(1));
    parts_.state = AxisState::Stopping;
  }
}

void AxisMotions::fail(ErrorCode code, double hardness) noexcept {
  answers_.finish(owner_, code);
  superimposed_.end(code);
  queue_.abort(answers_.table());
  release_stop();
  parts_.drive.home(false);
  give_back();
  if (!parts_.motion.at_rest()) {
    parts_.motion.stop(parts_.bounds.limits(hardness));
  }
  parts_.state = AxisState::ErrorStop;
}

// Checks what can be checked before the command begins.
ErrorCode AxisMotions::check(const Command& command) const noexcept {
  const AxisService service = axis_service_of(command);
  if (!parts_.drive.enabled() || parts_.state == AxisState::ErrorStop || parts_.state == AxisState::Stopping) {
    return ErrorCode::State;
  }
  const bool waits = command.buffer != BufferMode::Aborting;
  if (command.buffer < BufferMode::Aborting || command.buffer > BufferMode::BlendingHigh) {
    return ErrorCode::Value;
  }
  if ((parts_.state == AxisState::Homing && !waits) || (parts_.following.over() && waits)) {
    return ErrorCode::State;
  }
  if (service == AxisService::Home) {
    return waits || parts_.state == AxisState::Standstill ? ErrorCode::Ok : ErrorCode::State;
  }
  AxisOrder order;
  const bool adds = service == AxisService::MoveAdditive && is_to_position();
  const double from = adds ? parts_.motion.target() : parts_.commanded().position;
  const ErrorCode code = resolver_.resolve_whole(command, from, order);
  return waits && code != ErrorCode::Value ? ErrorCode::Ok : code;  // its start is not known yet
}

void AxisMotions::take(int ticket, const Command& command) noexcept {
  if (const ErrorCode code = check(command); code != ErrorCode::Ok) {
    answers_.answer(ticket, axis_service_of(command), code);
    return;
  }
  if (ticket < 0 || command.buffer == BufferMode::Aborting) {
    queue_.abort(answers_.table());
    // An additive target is added to the target of the previous motion.
    added_to_ = is_to_position() ? parts_.motion.target() : parts_.motion.state().position;
    answers_.finish(owner_, ErrorCode::Aborted);
    begin(ticket, command);
  } else if (!owner_.any() && queue_.empty()) {
    added_to_ = parts_.motion.state().position;
    begin(ticket, command);
  } else {
    queue_.push(ticket);
    choose_passing();
  }
}

void AxisMotions::begin(int ticket, const Command& command) noexcept {
  const AxisService service = axis_service_of(command);
  AxisOrder order;
  if (parts_.following.over()) {
    give_back();
  }
  began_at_ = service == AxisService::MoveAdditive ? added_to_ : parts_.motion.state().position;
  ErrorCode code = resolver_.resolve_whole(command, began_at_, order);
  if (service == AxisService::Home && (parts_.state == AxisState::ContinuousMotion || !parts_.motion.at_rest())) {
    code = ErrorCode::State;
  }
  if (code != ErrorCode::Ok) {
    // It had to be at rest; queued motions might lead anywhere from here.
    queue_.abort(answers_.table());
    answers_.answer(ticket, service, code);
    parts_.motion.stop(parts_.bounds.limits(1));
    parts_.state = parts_.busy() ? AxisState::Stopping : parts_.state;
    give_back();
    return;
  }
  owner_ = {ticket, service};
  answers_.active(ticket);
  begin_motion(command, order);
  choose_passing();
}

void AxisMotions::begin_motion(const Command& command, const AxisOrder& order) noexcept {
  const AxisService service = axis_service_of(command);
  if (service == AxisService::TorqueControl) {
    begin_torque(order);
  } else if (follows(service)) {
    parts_.leave_torque();
    couple(command, order);
  } else {
    give_back();
    begin_own(command, order);
  }
}

void AxisMotions::begin_own(const Command& command, const AxisOrder& order) noexcept {
  switch (axis_service_of(command)) {
    case AxisService::Home:
      home();
      break;
    case AxisService::Halt:
      parts_.motion.stop(order.braking);
      parts_.state = AxisState::DiscreteMotion;
      break;
    case AxisService::MoveVelocity: {
      const bool slower = std::abs(order.target) < std::abs(parts_.motion.state().velocity);
      parts_.motion.move_with(order.target, slower ? order.braking : order.limits);
      parts_.state = AxisState::ContinuousMotion;
      break;
    }
    case AxisService::MoveContinuousAbsolute:
    case AxisService::MoveContinuousRelative:
      parts_.motion.move_through(order.target, order.end, order.limits, order.braking);
      parts_.state = AxisState::ContinuousMotion;
      break;
    case AxisService::PositionProfile:
    case AxisService::VelocityProfile:
    case AxisService::AccelerationProfile:
      begin_profile(command);
      break;
    default:
      parts_.motion.move_to(order.target, order.limits, order.braking);
      parts_.state = AxisState::DiscreteMotion;
  }
}

void AxisMotions::begin_torque(const AxisOrder& order) noexcept {
  if (!parts_.pushing.on()) {
    give_back();
    parts_.motion.stop(order.braking);
  }
  parts_.pushing.begin(order, parts_.measured.speed);
  parts_.state = AxisState::ContinuousMotion;
}

void AxisMotions::begin_profile(const Command& command) noexcept {
  TimeProfile table;
  static_cast<void>(resolver_.read_table(command, table));  // checked before
  const bool to_rest = axis_service_of(command) == AxisService::PositionProfile;
  const AxisBounds::Own& own = parts_.bounds.own();
  parts_.motion.move_along(table, {own.velocity, own.acceleration, own.jerk}, to_rest);
  parts_.state = to_rest ? AxisState::DiscreteMotion : AxisState::ContinuousMotion;
}

void AxisMotions::couple(const Command& command, const AxisOrder& order) noexcept {
  AxisFollow way;
  static_cast<void>(resolver_.follow(command, order, way));  // checked before
  LineLimits limits = order.limits;
  limits.acceleration = std::min(limits.acceleration, order.braking.acceleration);
  superimposed_.end(ErrorCode::Aborted);
  parts_.following.engage(way, limits, parts_.bounds.most(), parts_.motion.state());
  parts_.state = AxisState::SynchronizedMotion;
  parts_.motion.stop(parts_.bounds.limits(1));
  parts_.motion.lend(parts_.motion.state());
}

void AxisMotions::decouple(int ticket) noexcept {
  if (!parts_.following.coupled()) {
    answers_.answer(ticket, AxisService::Decouple, ErrorCode::State);
    return;
  }
  queue_.abort(answers_.table());
  answers_.finish(owner_, ErrorCode::Aborted);
  give_back();
  parts_.motion.move_with(parts_.motion.state().velocity, parts_.bounds.limits(1));
  parts_.state = AxisState::ContinuousMotion;
  answers_.answer(ticket, AxisService::Decouple, ErrorCode::Ok);
}

void AxisMotions::home() noexcept {
  parts_.state = AxisState::Homing;
  parts_.homed = false;
  homing_ = 0;
  parts_.drive.home(true);
}

// The motion in progress has ended; the next one begins where it ended.
void AxisMotions::end_motion(ErrorCode code) noexcept {
  added_to_ = parts_.motion.state().position;
  answers_.finish(owner_, code);
  begin_next();
}

void AxisMotions::begin_next() noexcept {
  if (!queue_.empty()) {
    const int ticket = queue_.pop();
    begin(ticket, answers_.table().command(ticket));
  } else if (parts_.motion.passed()) {
    parts_.motion.stop(parts_.bounds.limits(1));
  }
}

void AxisMotions::end_request() noexcept {
  if (owner_.is_request()) {
    answers_.finish(owner_, ErrorCode::Aborted);
  }
  superimposed_.end_request();
}

void AxisMotions::update() noexcept {
  if (!owner_.is_command() || !answers_.table().updated(owner_.ticket) || is_profile(owner_.service)) {
    return;
  }
  const Command& command = answers_.table().command(owner_.ticket);
  AxisOrder order;
  ErrorCode code = resolver_.resolve(command, began_at_, order);
  const bool gone = goes_on_from(owner_.service) && parts_.motion.went_through(order.target);
  code = code == ErrorCode::Ok && !gone ? resolver_.check_way(command, order) : code;
  if (code != ErrorCode::Ok) {
    stop_with(code);
  } else if (gone) {
    parts_.motion.go_on_with(order.end, order.limits, order.braking);
  } else if (owner_.service != AxisService::Home) {
    begin_motion(command, order);
    choose_passing();
  }
}

// Ends the motion, and all that waits for it, and comes to rest.
void AxisMotions::stop_with(ErrorCode code) noexcept {
  queue_.abort(answers_.table());
  answers_.finish(owner_, code);
  give_back();
  parts_.motion.stop(parts_.bounds.limits(1));
  parts_.state = AxisState::Stopping;
}

// The axis' own motion continues from where others have led it.
void AxisMotions::give_back() noexcept {
  parts_.leave_torque();
  superimposed_.end(ErrorCode::Aborted);
  parts_.following.release(parts_.motion);
}

void AxisMotions::release_stop() noexcept {
  if (stop_ != AxisOwner::kNone) {
    const bool rests = parts_.motion.at_rest() && parts_.drive.enabled();
    answers_.table().end(stop_, rests ? ErrorCode::Ok : ErrorCode::Aborted);
    stop_ = AxisOwner::kNone;
  }
}

// Chooses the velocity with which the motion in progress blends into the next one.
void AxisMotions::choose_passing() noexcept {
  if (is_to_position()) {
    parts_.motion.pass_with(queue_.empty() ? 0 : passing_into_next());
  }
}

// It must be possible to come to rest where the next motion leads.
double AxisMotions::passing_into_next() const noexcept {
  constexpr double kLeastSpeed = 1e-6;
  const Command& next = answers_.table().command(queue_.front());
  const AxisService service = axis_service_of(next);
  AxisOrder order;
  const double end = parts_.motion.target();
  const bool works = resolver_.resolve(next, end, order) == ErrorCode::Ok;
  const double own = parts_.motion.speed();
  const double other = order.limits.velocity;
  const bool to_a_place = is_move(service) || goes_on_from(service);
  const double way = to_a_place ? order.target - end : order.target;
  const bool ahead = way * (end - began_at_) > 0;
  double passing = 0;
  if (works && ahead && (to_a_place || service == AxisService::MoveVelocity)) {
    passing = velocity_of(next.buffer, own, other);
  }
  while (passing > kLeastSpeed && to_a_place && ramp({0, passing, 0}, 0, order.braking).distance > std::abs(way)) {
    passing *= 0.98;
  }
  return passing > kLeastSpeed ? passing : 0;
}

}  // namespace indurop::robot
