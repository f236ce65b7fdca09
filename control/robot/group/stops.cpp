// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/stops.h"

#include <algorithm>

#include "control/robot/group/fault_text.h"

namespace indurop::robot {

namespace {

// Returns whether an error leaves the path unchanged: the other axes can still follow it.
bool keeps_path(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::Emergency:
    case ErrorCode::Contact:
    case ErrorCode::Drive:
    case ErrorCode::Power:
    case ErrorCode::Following:
    case ErrorCode::Planner:
    case ErrorCode::OtherRobot:
      return true;
    default:
      return false;
  }
}

// Returns whether the check ahead has ensured that each axis can brake on its own.
bool is_foreseen(ErrorCode code) noexcept {
  return code == ErrorCode::Collision || code == ErrorCode::Workspace;
}

}  // namespace

void Stops::trip(ErrorCode code, int axis, double hardness, const char* why) noexcept {
  const Settings& settings = robot_.parts.settings;
  group_.set_job_aside();
  FaultText text;
  name_axis({code, axis}, robot_.parts.arm, text);
  robot_.job.fail({code, axis}, why != nullptr ? why : text, JobRunner::kReported);
  group_.finish_service(Fault{code, axis});
  group_.drop_motions(code);
  group_.forget_plans();
  power_.cancel();
  robot_.states.stop_to_error(code, axis);
  release();
  gate_.set_hardness(std::max(gate_.hardness(), hardness));
  const bool cut = code == ErrorCode::Emergency && settings.emergency_category == StopCategory::Category0;
  for (AxisControl& a : robot_.axes) {
    a.power(a.wants_power() && !cut);
  }
  const bool on_it = !robot_.follower.idle() && !off_path_.conveyor.on() && robot_.states.on_path();
  if (!on_it || !keeps_path(code) || cut) {
    leave_path(code);
    return;
  }
  robot_.follower.stop_hard(gate_.hardness() * off_path_.correction.path_share());
  for (AxisControl& a : robot_.axes) {
    if (!a.in_group()) {
      a.fail(code, gate_.hardness());
    }
  }
}

// During a stop the first error remains the reported one.
void Stops::fall_off(ErrorCode code, int axis) noexcept {
  if (robot_.states.to_error()) {
    leave_path(robot_.states.error());
  } else {
    trip(code, axis, 1, nullptr);
  }
}

// The gates know speed and acceleration of the axes as their drives do, so they can brake whatever error occurred
// before.
void Stops::leave_path(ErrorCode code) noexcept {
  const bool alone = robot_.axes.any_busy();
  off_path_.conveyor.drop(code);
  off_path_.correction.stand();
  robot_.follower.reset(robot_.commanded());
  gate_.begin_braking(!alone && !off_path_.guiding.on() && !is_foreseen(code));
  for (AxisControl& a : robot_.axes) {
    a.fail(code, gate_.hardness());
  }
}

void Stops::stop_for(const Fault& fault) noexcept {
  group_.forget_plans();
  rest();
  robot_.states.stop_to_error(fault.code, fault.axis);
}

void Stops::stop_for_job() noexcept {
  const Fault fault = robot_.job.fault();
  group_.finish_service(Fault{fault.code, fault.axis});
  stop_for(fault);
}

void Stops::stop_for_mode(ErrorCode code) noexcept {
  GroupStates& states = robot_.states;
  const double hardness = robot_.parts.settings.emergency_factor;
  if (states.to_error()) {
    return;
  }
  group_.set_job_aside();
  if (robot_.job.running()) {
    robot_.job.stop();
    robot_.job.set_message(to_string(code));
  }
  group_.finish_service(code);
  group_.drop_motions(code);
  group_.forget_plans();
  if (robot_.axes.any_busy() || (!states.moving() && !(states.stopping() && states.on_path()))) {
    halt_axes();
    states.leave_path();
  } else if (off_path_.guiding.on()) {
    gate_.begin_braking(false);
  } else if (code != ErrorCode::Enabling) {
    robot_.follower.stop();
  } else if (off_path_.conveyor.on()) {
    off_path_.conveyor.drop(code);
    robot_.follower.reset(robot_.commanded());
    gate_.set_hardness(hardness);
    gate_.begin_braking(true);
  } else {
    gate_.set_hardness(hardness);
    robot_.follower.stop_hard(hardness * off_path_.correction.path_share());
  }
  if (states.powered()) {
    states.stop();
  }
}

void Stops::halt_axes() noexcept {
  robot_.follower.reset(robot_.commanded());
  robot_.axes.halt();
}

// Ends the job, and its motions with it.
void Stops::stop_motion() noexcept {
  group_.set_job_aside();
  robot_.job.stop();
  group_.forget_plans();
}

// Comes to rest on the path, or where an axis pushes.
void Stops::rest() noexcept {
  if (robot_.axes.any_busy()) {
    halt_axes();
    robot_.states.leave_path();
  } else if (off_path_.guiding.on()) {
    gate_.begin_braking(false);  // each axis on its own, as was checked ahead
  } else {
    robot_.follower.stop();
  }
}

void Stops::take(int ticket) noexcept {
  GroupStates& states = robot_.states;
  if (!states.powered() || states.to_error() || states.to_disabled()) {
    robot_.table.end(ticket, ErrorCode::State);
    return;
  }
  group_.finish_service(ErrorCode::Aborted);
  release();
  ticket_ = ticket;
  robot_.table.active(ticket);
  if (states.stopping()) {
    return;
  }
  stop_motion();
  if (states.moving()) {
    rest();
  } else {
    states.leave_path(robot_.axes.any_busy());
    halt_axes();
  }
  states.stop();
}

void Stops::release() noexcept {
  const GroupStates& states = robot_.states;
  if (held_by_command()) {
    const bool done = !states.to_error() && !states.to_disabled() && !robot_.table.execute(ticket_);
    robot_.table.end(ticket_, done ? ErrorCode::Ok : ErrorCode::Aborted);
    ticket_ = CommandTable::kNone;
  }
}

ErrorCode Stops::stop() noexcept {
  if (robot_.states.resting()) {
    group_.finish_service(ErrorCode::Ok);
    return ErrorCode::Ok;
  }
  if (!robot_.states.moving()) {
    return ErrorCode::State;
  }
  stop_motion();
  rest();
  robot_.states.stop();
  return ErrorCode::Ok;
}

ErrorCode Stops::disable() noexcept {
  GroupStates& states = robot_.states;
  if (states.is(GroupState::Homing) || states.stopping()) {
    return ErrorCode::State;
  }
  stop_motion();
  power_.cancel();
  if (states.moving()) {
    rest();
    states.stop_to_disabled();
    return ErrorCode::Ok;
  }
  if (states.is(GroupState::Standby)) {
    robot_.stand_here();  // it may have come to Standby in the last period, and the follower is elsewhere
    if (robot_.axes.any_busy()) {
      halt_axes();
      states.leave_path();
    }
    states.stop_to_disabled();
    return ErrorCode::Ok;
  }
  robot_.axes.give_up_power();
  group_.finish_service(ErrorCode::Ok);
  return ErrorCode::Ok;
}

void Stops::step() noexcept {
  GroupStates& states = robot_.states;
  const bool ended = states.on_path() ? robot_.follower.idle() && off_path_.at_rest() : robot_.axes.at_rest();
  if (!ended) {
    return;
  }
  off_path_.correction.stand();
  if (states.to_error()) {
    states.error_stop();
    for (AxisControl& a : robot_.axes) {
      a.rest();
      a.fail(states.error(), 1);
    }
    power_.set_quick_stop(states.error() == ErrorCode::Emergency || states.error() == ErrorCode::Planner);
  } else if (states.to_disabled()) {
    group_.end_motion();
    states.disable();
    robot_.axes.give_up_power();
    group_.finish_service(ErrorCode::Ok);
  } else if (held_by_command() && robot_.table.execute(ticket_)) {
    robot_.table.holds(ticket_);
    return;
  } else {
    group_.come_to_standby();
    group_.finish_service(ErrorCode::Ok);
  }
  release();
  states.end_stop();
}

}  // namespace indurop::robot
