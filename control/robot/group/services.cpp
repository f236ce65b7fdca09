// SPDX-License-Identifier: Apache-2.0
// Services of the group: accepts a request, executes it depending on the state, and reports its end.

#include <algorithm>
#include <cmath>

#include "control/robot/group/group.h"

namespace indurop::robot {

namespace {

bool is_move(Service service) noexcept {
  return service == Service::MoveJoints || service == Service::MoveLine || service == Service::MoveCircle ||
         service == Service::DirectAbsolute || service == Service::LinearAbsolute;
}

// Full speed if none is given.
double part_of_speed(const ServiceRequest& request, bool direct) noexcept {
  const double percent = direct && request.velocity != 0 ? request.velocity : request.speed;
  return percent == 0 ? 1 : percent / 100;
}

}  // namespace

void Group::serve(const ServiceRequest& request, bool edit) noexcept {
  if (first_) {
    // Requests from before this program started are ignored.
    first_ = false;
    acknowledged_ = done_ = request.number;
    error_ = request.number != 0 ? ErrorCode::Aborted : ErrorCode::Ok;
    return;
  }
  edit_done_ = edit_done_ && edit;
  const bool numbered = request.number != acknowledged_;
  if (!numbered && (!edit || by_edit_ || edit_done_)) {
    by_edit_ = by_edit_ && (edit || active_);
    return;
  }
  if (is_move(static_cast<Service>(request.code)) && state_ == GroupState::Moving && !job_.running() && !desk_.free()) {
    return;  // the motion before it is still being planned
  }
  const auto asked = static_cast<Service>(request.code);
  if ((asked == Service::SelectTool || asked == Service::JobStart || asked == Service::JobResume) && settled() &&
      desk_.holds_forgotten()) {
    return;  // a plan for the tool before is still being checked
  }
  if (asked == Service::JobResume && comes_to_rest()) {
    return;  // it continues at standstill
  }
  acknowledged_ = request.number;
  by_edit_ = !numbered;
  if (active_ && ticket_ != CommandTable::kNone) {
    finish_service(ErrorCode::Aborted);
  }
  begin_service(asked > Service::JobBack && asked != Service::JobReload ? static_cast<Service>(-1) : asked, request);
}

// Returns whether a job was stopped and nothing else prevents its continuation.
bool Group::comes_to_rest() const noexcept {
  return state_ == GroupState::Stopping && aside_ && !to_error_ && !to_disabled_ && stop_ == CommandTable::kNone &&
         permit_ == ErrorCode::Ok;
}

void Group::begin_service(Service service, const ServiceRequest& request) noexcept {
  service_ = service;
  active_ = true;
  motion_done_ = false;
  if (!failed()) {
    error_ = ErrorCode::Ok;
    error_axis_ = 0;
  }
  if (const ErrorCode code = begin(service_, request); code != ErrorCode::Ok) {
    finish_service(code);
  }
}

void Group::finish_service(ErrorCode code, int axis) noexcept {
  if (!active_) {
    return;
  }
  active_ = false;
  if (ticket_ != CommandTable::kNone) {
    table_.end(ticket_, code);
    ticket_ = CommandTable::kNone;
    error_axis_ = failed() ? error_axis_ : axis;
    return;
  }
  done_ = acknowledged_;
  motion_done_ = code == ErrorCode::Ok;
  edit_done_ = by_edit_;
  by_edit_ = false;
  if (!failed()) {
    error_ = code;
    error_axis_ = axis;
  }
}

ErrorCode Group::begin(Service service, const ServiceRequest& request) noexcept {
  const bool ends_it = service == Service::Stop || service == Service::JobStop || service == Service::GroupDisable;
  if (tracking_.on() && !ends_it && service != Service::None && service != Service::GroupReset) {
    return ErrorCode::State;
  }
  switch (service) {
    case Service::None:
      finish_service(ErrorCode::Ok);
      return ErrorCode::Ok;
    case Service::GroupEnable:
      return enable();
    case Service::GroupDisable:
      return disable();
    case Service::GroupReset:
      waited_ = 0;
      return reset();
    case Service::GroupHome:
      return home();
    case Service::MoveJoints:
    case Service::MoveLine:
    case Service::MoveCircle:
    case Service::DirectAbsolute:
    case Service::LinearAbsolute:
      return move(service, request);
    case Service::DirectAborting:
      return redirect(request);
    case Service::Stop:
    case Service::JobStop:
      return stop_motion();
    case Service::JobStart:
      return start_job(request.job, request.line);
    case Service::JobResume:
      return resume_job();
    case Service::JobBack:
      return back_job();
    case Service::SelectTool:
      return select_tool(request.tool);
    case Service::JobReload:
      return ErrorCode::Ok;  // run_reload() continues with it
    default:
      break;
  }
  return ErrorCode::Opcode;
}

ErrorCode Group::enable() noexcept {
  if (emergency_) {
    return ErrorCode::Emergency;
  }
  if (state_ == GroupState::Standby) {
    finish_service(ErrorCode::Ok);
    return ErrorCode::Ok;
  }
  if (state_ != GroupState::Disabled) {
    return ErrorCode::State;
  }
  enabling_ = true;
  quick_stop_ = false;
  waited_ = 0;
  // A drive that was commanded to switch off reports it later: its present status is ignored.
  letting_go_ = lets_go();
  if (!letting_go_) {
    take_power();
  }
  return ErrorCode::Ok;
}

ErrorCode Group::disable() noexcept {
  if (state_ == GroupState::Homing || state_ == GroupState::Stopping) {
    return ErrorCode::State;
  }
  set_job_aside();
  job_.stop();
  forget_plans();
  enabling_ = false;
  if (state_ == GroupState::Moving || state_ == GroupState::Standby) {
    follower_.stop();
    state_ = GroupState::Stopping;
    to_disabled_ = true;
    return ErrorCode::Ok;
  }
  for (AxisControl& a : axes()) {
    a.give_up_power();
  }
  finish_service(ErrorCode::Ok);
  return ErrorCode::Ok;
}

ErrorCode Group::home() noexcept {
  const bool free = std::all_of(axes().begin(), axes().end(), [](const AxisControl& a) { return !a.busy(); });
  if (state_ != GroupState::Standby || !free || permit_ != ErrorCode::Ok) {
    return permit_ != ErrorCode::Ok ? permit_ : ErrorCode::State;
  }
  for (AxisControl& a : axes()) {
    a.home();
  }
  state_ = GroupState::Homing;
  return ErrorCode::Ok;
}

// Checks whether a service may move the robot, which it may not while a job does.
ErrorCode Group::may_move() const noexcept {
  if (permit_ != ErrorCode::Ok) {
    return permit_;
  }
  const bool free = std::none_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.busy(); });
  if (!(state_ == GroupState::Standby && free) && !(state_ == GroupState::Moving && !job_.running())) {
    return ErrorCode::State;
  }
  const bool homed = std::all_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.homed(); });
  return homed ? ErrorCode::Ok : ErrorCode::NotHomed;
}

ErrorCode Group::move(Service service, const ServiceRequest& request) noexcept {
  if (!can_plan() || motion_count_ > 0) {
    return ErrorCode::State;
  }
  if (const ErrorCode code = may_move(); code != ErrorCode::Ok) {
    return code;
  }
  MoveCommand command;
  const bool direct = service == Service::DirectAbsolute;
  const bool linear = service == Service::LinearAbsolute;
  command.move = service == Service::MoveCircle           ? Move::Circle
                 : service == Service::MoveLine || linear ? Move::Line
                                                          : Move::Joint;
  command.speed = part_of_speed(request, direct);
  command.zone = request.level / 100.0;
  const Eigen::Map<const Joints, Eigen::Unaligned> numbers(request.target.data());
  if (direct) {
    for (int i = 0; i < count(); ++i) {
      command.target.joints[i] = numbers[i] * axes_[static_cast<std::size_t>(i)].unit();
    }
  } else if (linear) {
    command.target.is_pose = true;
    command.target.pose.position = numbers.head<3>() / 1000;
    command.target.pose.orientation = from_rpy(numbers.segment<3>(3) * (kPi / 180));
    command.tool_speed = request.velocity / 1000;
  } else {
    const int target = parts_.book.numbered_point(request.point);
    const int mid = service == Service::MoveCircle ? parts_.book.numbered_point(request.mid) : target;
    if (target < 0 || mid < 0) {
      return ErrorCode::Point;
    }
    command.target = parts_.book.target(target, tool_);
    command.mid = parts_.book.target(mid, tool_);
  }
  ask_for_plan({command, nullptr, planned_end(), !follower_.idle()});
  state_ = GroupState::Moving;
  return ErrorCode::Ok;
}

// Done at once in the tick, since the present motion of the joints is part of it: takes a few microseconds.
ErrorCode Group::redirect(const ServiceRequest& request) noexcept {
  if (const ErrorCode code = may_move(); code != ErrorCode::Ok) {
    return code;
  }
  Joints to = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    to[i] = request.target[k] * axes_[k].unit();
  }
  const double speed = part_of_speed(request, true);
  if (!to.allFinite() || !(speed > 0 && speed <= 1)) {
    return ErrorCode::Value;
  }
  Fault fault;
  if (const int beyond = parts_.arm.beyond_limits(to); beyond >= 0) {
    fault = {ErrorCode::JointLimit, beyond + 1};
  } else {
    if (follower_.idle()) {
      follower_.reset(commanded());
      last_command_ = commanded();
    }
    fault = follower_.redirect(Segment::together_to(to, speed));
  }
  if (!fault.ok()) {
    finish_service(fault.code, fault.axis);
    return ErrorCode::Ok;
  }
  forget_plans();
  state_ = GroupState::Moving;
  return ErrorCode::Ok;
}

ErrorCode Group::start_job(std::uint32_t number, std::uint32_t line) noexcept {
  const bool free = std::none_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.busy(); });
  if (number == 0 || number > parts_.book.jobs.size()) {
    return ErrorCode::Job;
  }
  if (state_ != GroupState::Standby || !free || permit_ != ErrorCode::Ok) {
    return permit_ != ErrorCode::Ok ? permit_ : ErrorCode::State;
  }
  if (std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return !a.homed(); })) {
    return ErrorCode::NotHomed;
  }
  drop_aside();
  if (!job_.start(static_cast<int>(number) - 1, line)) {
    job_.stop();
    return ErrorCode::Value;
  }
  if (!take_tool(job_.tool()) || !take_load(job_.load())) {
    job_.stop();
    return ErrorCode::State;  // a job must not depend on the load of the job before
  }
  follower_.reset(commanded());
  last_command_ = commanded();
  state_ = GroupState::Moving;
  job_moves_ = true;
  return ErrorCode::Ok;
}

// Returns false while an abandoned plan, made for the tool before, is still being checked.
bool Group::take_tool(int tool) noexcept {
  if (!settled() || desk_.holds_forgotten()) {
    return false;
  }
  if (tool != tool_) {
    tool_ = tool;
    places_.take(tools_.arm(tool), tools_.inverse(tool), tool);
    weigh();
    last_pose_ = places_.arm().forward(last_command_);
  }
  return true;
}

// Only between motions: a moving robot continues with the tool it was planned for.
ErrorCode Group::select_tool(std::uint32_t tool) noexcept {
  if (tool >= parts_.book.tools.size()) {
    return ErrorCode::Tool;
  }
  const bool stands = state_ == GroupState::Standby || state_ == GroupState::Disabled;
  if (!stands || !take_tool(static_cast<int>(tool))) {
    return ErrorCode::State;
  }
  finish_service(ErrorCode::Ok);
  return ErrorCode::Ok;
}

ErrorCode Group::stop_motion() noexcept {
  if (state_ == GroupState::Standby || state_ == GroupState::Disabled) {
    finish_service(ErrorCode::Ok);
    return ErrorCode::Ok;
  }
  if (state_ != GroupState::Moving) {
    return ErrorCode::State;
  }
  set_job_aside();
  job_.stop();
  forget_plans();
  follower_.stop();
  state_ = GroupState::Stopping;
  return ErrorCode::Ok;
}

}  // namespace indurop::robot
