// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/motion_queue.h"

#include <algorithm>

namespace indurop::robot {

namespace {

// The number by which the planner and the follower know a motion; motions of jobs have positive ones.
int source_of(int ticket) noexcept {
  return -ticket - 1;
}

// Returns whether the target of a motion is known before the motion in front of it has been planned.
bool is_known_ahead(const Command& command) noexcept {
  const Service service = group_service_of(command);
  return command.coords != CoordSystem::Axes || service == Service::DirectAbsolute || is_free(service);
}

// Returns whether a motion is possible while the tool presses. The set points of joint motions are no lines that could
// be shifted, and a free motion is clear only where it was searched for.
bool may_follow(Service motion, GroupStates::Press press) noexcept {
  const bool shifts = !is_direct(motion) && !is_free(motion);
  return press == GroupStates::Press::Off || motion == Service::Halt || (press == GroupStates::Press::On && shifts);
}

}  // namespace

void MotionQueue::take(int ticket) noexcept {
  const Command& command = robot_.table.command(ticket);
  ErrorCode code = group_.may_move();
  if (code == ErrorCode::Ok && group_.is_serving() && robot_.states.moving()) {
    code = ErrorCode::State;  // a service is moving it
  }
  if (code == ErrorCode::Ok && !is_sane(command)) {
    code = ErrorCode::Value;
  }
  if (code == ErrorCode::Ok && !may_follow(group_service_of(command), robot_.states.press())) {
    code = ErrorCode::State;
  }
  code = code == ErrorCode::Ok ? check_product(command) : code;
  if (code != ErrorCode::Ok) {
    robot_.table.end(ticket, code);
    return;
  }
  if (command.buffer == BufferMode::Aborting) {
    replace_all(ticket);
    return;
  }
  motions_[at(count_++)] = ticket;
  begin_moving();
}

// A free motion is proven clear where it is searched for, so no belt may move it.
ErrorCode MotionQueue::check_product(const Command& command) const noexcept {
  if (command.coords != CoordSystem::Product) {
    return ErrorCode::Ok;
  }
  if (conveyor_.product_lost()) {
    return ErrorCode::Belt;
  }
  return is_free(group_service_of(command)) && conveyor_.product_moves() ? ErrorCode::State : ErrorCode::Ok;
}

void MotionQueue::begin_moving() noexcept {
  if (robot_.states.is(GroupState::Standby)) {
    group_.drop_aside();  // an interrupted job is not continued after other motions
    robot_.stand_here();
    robot_.states.move();
  }
}

// Joint motions start from any motion of the joints; for a line or circle it first has to come to rest on the path.
void MotionQueue::replace_all(int ticket) noexcept {
  const Command& command = robot_.table.command(ticket);
  const Follower& follower = robot_.follower;
  const bool joints =
      is_direct(group_service_of(command)) && command.coords == CoordSystem::Axes && !follower.stopping();
  int fed = 0;
  if (joints && !follower.idle() && !conveyor_.on()) {
    if (const ErrorCode code = redirect(ticket); code != ErrorCode::Ok) {
      robot_.table.end(ticket, code);
      return;
    }
    group_.forget_plans();
    fed = 1;
  } else {
    group_.forget_plans();
    robot_.follower.stop();
  }
  motions_[0] = ticket;
  count_ = 1;
  fed_ = fed;
  begin_moving();
}

ErrorCode MotionQueue::redirect(int ticket) noexcept {
  const Command& command = robot_.table.command(ticket);
  start_ = {};
  const Joints given = robot_.axes.from_users(command.to.data());
  const Joints to = group_service_of(command) == Service::DirectRelative ? Joints(robot_.commanded() + given) : given;
  if (robot_.parts.arm.beyond_limits(to) >= 0) {
    return ErrorCode::JointLimit;
  }
  Segment segment = Segment::together_to(to, command.velocity == 0 ? 1 : command.velocity / 100);
  segment.source = source_of(ticket);
  return robot_.follower.redirect(segment).code;
}

// Distance before its end at which it may blend into the next one.
double MotionQueue::zone_of(int i) const noexcept {
  if (i + 1 >= count_) {
    return 0;
  }
  const Command& next = command(i + 1);
  if (is_free(group_service_of(command(i)))) {
    return 0;
  }
  const auto on_product = [](const Command& c) { return c.coords == CoordSystem::Product; };
  if (conveyor_.product_moves() && on_product(next) != on_product(command(i))) {
    return 0;  // in between, the tool synchronizes with the product or leaves it
  }
  return next.buffer >= BufferMode::BlendingLow && group_service_of(next) != Service::Halt ? next.transition / 1000 : 0;
}

// Plans the motion that is followed, and the next one.
void MotionQueue::feed() noexcept {
  constexpr int kAhead = 2;
  ReadAhead& ahead = plans_.ahead();
  bool goes_on = false;
  while (fed_ < count_ && (goes_on ? ahead.has_room() : fed_ < kAhead && ahead.empty() && plans_.can_plan())) {
    const int ticket = motions_[at(fed_)];
    const Command& next = robot_.table.command(ticket);
    if (group_service_of(next) == Service::Halt) {
      halt(ticket);
      return;
    }
    ErrorCode code = check_product(next);
    const bool there =
        code == ErrorCode::Ok && (goes_on || conveyor_.reaches(next.coords == CoordSystem::Product, code));
    if (there && !goes_on) {
      start_ = robot_.tip(conveyor_.planned_end());
    }
    MoveCommand move;
    move.source = source_of(ticket);
    if (there) {
      code = motion_.make(next, start_, move);
    }
    if (code != ErrorCode::Ok) {
      fail(move.source, code);
    }
    if (!there || code != ErrorCode::Ok) {
      return;
    }
    move.zone = zone_of(fed_);
    ahead.add(move);
    start_ = move.target.is_pose ? move.target.pose : robot_.tip(move.target.joints);
    ++fed_;
    goes_on = move.zone > 0 && fed_ < count_ && is_known_ahead(command(fed_));
  }
}

// Executes a halt when it is its turn.
void MotionQueue::halt(int ticket) noexcept {
  if (fed_ > 0) {
    return;
  }
  robot_.table.active(ticket);
  robot_.follower.stop();
  conveyor_.leave(false);
  if (robot_.follower.idle() && !conveyor_.on() && !robot_.states.pressing()) {
    end_first(1, ErrorCode::Ok);
  }
}

void MotionQueue::note_progress() noexcept {
  const Follower& follower = robot_.follower;
  if (interrupt_ != CommandTable::kNone && follower.at_rest() && conveyor_.at_rest()) {
    answer_interrupt(ErrorCode::Ok);
  }
  if (fed_ == 0) {
    return;
  }
  const bool waiting = follower.idle();
  const bool planned = plans_.free() && plans_.ahead().empty();
  int present = follower.source();
  if (waiting) {
    present = planned ? 0 : plans_.source();
  }
  int done = fed_;
  for (int i = 0; i < fed_ && present != 0; ++i) {
    if (source_of(motions_[at(i)]) == present) {
      done = i;
      break;
    }
  }
  if (present != 0 && done == fed_) {
    return;
  }
  if (conveyor_.on() && !conveyor_.is_synchronized()) {
    done = 0;  // it has not arrived as long as the tool is not on the belt
  }
  end_first(done, ErrorCode::Ok);
  if (fed_ > 0 && !waiting) {
    if (interrupted_) {
      robot_.table.waits(motions_[0]);
    } else {
      robot_.table.active(motions_[0]);
    }
  }
}

void MotionQueue::end_first(int many, ErrorCode code) noexcept {
  for (int i = 0; i < many; ++i) {
    robot_.table.end(motions_[at(i)], code);
  }
  std::copy(motions_.begin() + many, motions_.begin() + count_, motions_.begin());
  count_ -= many;
  fed_ = std::max(0, fed_ - many);
}

void MotionQueue::fail(int source, ErrorCode code) noexcept {
  int i = 0;
  while (i < count_ && source_of(motions_[at(i)]) != source) {
    ++i;
  }
  for (int k = i; k < count_; ++k) {
    robot_.table.end(motions_[at(k)], k == i ? code : ErrorCode::Aborted);
  }
  count_ = i;
  fed_ = std::min(fed_, i);
  plans_.ahead().clear();
}

void MotionQueue::drop(ErrorCode first) noexcept {
  for (int k = 0; k < count_; ++k) {
    robot_.table.end(motions_[at(k)], k == 0 ? first : ErrorCode::Aborted);
  }
  count_ = fed_ = 0;
}

void MotionQueue::interrupt(int ticket) noexcept {
  if (!robot_.states.moving()) {
    robot_.table.end(ticket, ErrorCode::State);
    return;
  }
  answer_interrupt(ErrorCode::Aborted);
  interrupted_ = true;
  interrupt_ = ticket;
  robot_.table.active(ticket);
}

void MotionQueue::go_on(int ticket) noexcept {
  robot_.table.end(ticket, interrupted_ ? ErrorCode::Ok : ErrorCode::State);
  end_interrupt(ErrorCode::Aborted);
}

void MotionQueue::end_interrupt(ErrorCode code) noexcept {
  interrupted_ = false;
  answer_interrupt(code);
}

void MotionQueue::answer_interrupt(ErrorCode code) noexcept {
  if (interrupt_ != CommandTable::kNone) {
    robot_.table.end(interrupt_, code);
    interrupt_ = CommandTable::kNone;
  }
}

}  // namespace indurop::robot
