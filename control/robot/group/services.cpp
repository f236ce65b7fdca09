// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/services.h"

#include <cmath>

namespace indurop::robot {

namespace {

// Full speed if none is given.
double part_of_speed(const ServiceRequest& request, bool direct) noexcept {
  const double percent = direct && request.velocity != 0 ? request.velocity : request.speed;
  return percent == 0 ? 1 : percent / 100;
}

}  // namespace

bool Services::comes_to_rest() const noexcept {
  const GroupStates& states = robot_.states;
  return states.stopping() && parts_.resuming.aside() && !states.to_error() && !states.to_disabled() &&
         !parts_.stops.held_by_command() && parts_.mode.permit() == ErrorCode::Ok;
}

ErrorCode Services::begin(Service service, const ServiceRequest& request) noexcept {
  const bool ends_it = service == Service::Stop || service == Service::JobStop || service == Service::GroupDisable;
  const bool off_path = parts_.conveyor.on() || parts_.guiding.on() || robot_.states.pressing();
  if (off_path && !ends_it && service != Service::None && service != Service::GroupReset) {
    return ErrorCode::State;
  }
  switch (service) {
    case Service::None:
      group_.finish_service(ErrorCode::Ok);
      return ErrorCode::Ok;
    case Service::GroupEnable:
      return parts_.power.enable();
    case Service::GroupDisable:
      return parts_.stops.disable();
    case Service::GroupReset:
      return parts_.power.begin_reset();
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
      return parts_.stops.stop();
    case Service::JobStart:
      return start_job(request.job, request.line);
    case Service::JobResume:
      return parts_.resuming.resume();
    case Service::JobBack:
      return parts_.resuming.step_back();
    case Service::SelectTool:
      return select_tool(request.tool);
    case Service::JobReload:
      return ErrorCode::Ok;  // Reloading continues with it
    default:
      break;
  }
  return ErrorCode::Opcode;
}

// Checks whether homing or a job may begin.
ErrorCode Services::may_begin() const noexcept {
  if (parts_.mode.permit() != ErrorCode::Ok) {
    return parts_.mode.permit();
  }
  return robot_.states.is(GroupState::Standby) && !robot_.axes.any_busy() ? ErrorCode::Ok : ErrorCode::State;
}

ErrorCode Services::home() noexcept {
  if (const ErrorCode code = may_begin(); code != ErrorCode::Ok) {
    return code;
  }
  for (AxisControl& a : robot_.axes) {
    a.home();
  }
  robot_.states.home();
  return ErrorCode::Ok;
}

ErrorCode Services::may_move() const noexcept {
  if (parts_.mode.permit() != ErrorCode::Ok) {
    return parts_.mode.permit();
  }
  const GroupStates& states = robot_.states;
  const bool free = !robot_.axes.any_busy() && !parts_.guiding.on();
  if (!(states.is(GroupState::Standby) && free) &&
      !(states.moving() && !robot_.job.running() && !parts_.guiding.on())) {
    return ErrorCode::State;
  }
  return robot_.axes.all_homed() ? ErrorCode::Ok : ErrorCode::NotHomed;
}

ErrorCode Services::make_move(Service service, const ServiceRequest& request, MoveCommand& command) const noexcept {
  const bool direct = service == Service::DirectAbsolute;
  const bool linear = service == Service::LinearAbsolute;
  command.move = service == Service::MoveCircle           ? Move::Circle
                 : service == Service::MoveLine || linear ? Move::Line
                                                          : Move::Joint;
  command.speed = part_of_speed(request, direct);
  command.zone = request.level / 100.0;
  if (direct) {
    command.target.joints = robot_.axes.from_users(request.target.data());
    return ErrorCode::Ok;
  }
  if (linear) {
    const Eigen::Map<const Joints, Eigen::Unaligned> numbers(request.target.data());
    command.target.is_pose = true;
    command.target.pose.position = numbers.head<3>() / 1000;
    command.target.pose.orientation = from_rpy(numbers.segment<3>(3) * (kPi / 180));
    command.tool_speed = request.velocity / 1000;
    return ErrorCode::Ok;
  }
  const JobBook& book = robot_.parts.book;
  const int target = book.numbered_point(request.point);
  const int mid = service == Service::MoveCircle ? book.numbered_point(request.mid) : target;
  if (target < 0 || mid < 0) {
    return ErrorCode::Point;
  }
  command.target = book.target(target, robot_.tool.number());
  command.mid = book.target(mid, robot_.tool.number());
  return ErrorCode::Ok;
}

ErrorCode Services::move(Service service, const ServiceRequest& request) noexcept {
  if (!parts_.plans.can_plan() || !parts_.queue.empty()) {
    return ErrorCode::State;
  }
  if (const ErrorCode code = may_move(); code != ErrorCode::Ok) {
    return code;
  }
  MoveCommand command;
  if (const ErrorCode code = make_move(service, request, command); code != ErrorCode::Ok) {
    return code;
  }
  parts_.plans.ask({command, nullptr, parts_.conveyor.planned_end(), !robot_.follower.idle()});
  robot_.states.move();
  return ErrorCode::Ok;
}

// Done at once in the tick, since the present motion of the joints is part of it: takes a few microseconds.
ErrorCode Services::redirect(const ServiceRequest& request) noexcept {
  if (const ErrorCode code = may_move(); code != ErrorCode::Ok) {
    return code;
  }
  const Joints to = robot_.axes.from_users(request.target.data());
  const double speed = part_of_speed(request, true);
  if (!to.allFinite() || !(speed > 0 && speed <= 1)) {
    return ErrorCode::Value;
  }
  Fault fault;
  if (const int beyond = robot_.parts.arm.beyond_limits(to); beyond >= 0) {
    fault = {ErrorCode::JointLimit, beyond + 1};
  } else {
    if (robot_.follower.idle()) {
      robot_.stand_here();
    }
    fault = robot_.follower.redirect(Segment::together_to(to, speed));
  }
  if (!fault.ok()) {
    group_.finish_service(fault);
    return ErrorCode::Ok;
  }
  group_.forget_plans();
  robot_.states.move();
  return ErrorCode::Ok;
}

ErrorCode Services::start_job(std::uint32_t number, std::uint32_t line) noexcept {
  if (number == 0 || number > robot_.parts.book.jobs.size()) {
    return ErrorCode::Job;
  }
  if (const ErrorCode code = may_begin(); code != ErrorCode::Ok) {
    return code;
  }
  if (!robot_.axes.all_homed()) {
    return ErrorCode::NotHomed;
  }
  group_.drop_aside();
  JobRunner& job = robot_.job;
  if (!job.start(static_cast<int>(number) - 1, line)) {
    job.stop();
    return ErrorCode::Value;
  }
  if (!parts_.job.take_tool(job.tool()) || !parts_.job.take_load(job.load())) {
    job.stop();
    return ErrorCode::State;  // a job must not depend on the load of the job before
  }
  robot_.stand_here();
  robot_.states.move(true);
  return ErrorCode::Ok;
}

// Only between motions: a moving robot continues with the tool it was planned for.
ErrorCode Services::select_tool(std::uint32_t tool) noexcept {
  if (tool >= robot_.parts.book.tools.size()) {
    return ErrorCode::Tool;
  }
  if (!robot_.states.resting() || !parts_.job.take_tool(static_cast<int>(tool))) {
    return ErrorCode::State;
  }
  group_.finish_service(ErrorCode::Ok);
  return ErrorCode::Ok;
}

}  // namespace indurop::robot
