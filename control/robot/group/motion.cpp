// SPDX-License-Identifier: Apache-2.0
// The group in each of its states: how a period of it goes, and which state follows.

#include "control/robot/group/fault_text.h"
#include "control/robot/group/group.h"

namespace indurop::robot {

void Group::run_state(Signals& signals) noexcept {
  if (!robot_.job.step_outputs(robot_.period, signals, job_motions_)) {
    stops_.stop_for_job();
  }
  reloading_.step(service_.is_serving(Service::JobReload), queue_.empty() && !power_.enabling(), signals);
  torques_.weigh_pushing();
  robot_.axes.move();
  switch (robot_.states.state()) {
    case GroupState::Disabled:
      reset_further();
      power_.run_enabling();
      break;
    case GroupState::Standby:
    case GroupState::ErrorStop:
      robot_.follower.reset(robot_.commanded());
      reset_further();
      break;
    case GroupState::Homing:
      run_homing();
      break;
    case GroupState::Moving:
      run_motion(signals);
      break;
    case GroupState::Stopping:
      if (robot_.states.on_path()) {
        follow_path();
      }
      stops_.step();
      break;
  }
}

void Group::reset_further() noexcept {
  if (!service_.is_serving(Service::GroupReset)) {
    return;
  }
  if (const ErrorCode code = power_.reset(); code != ErrorCode::Ok) {
    finish_service(code);
  }
}

void Group::run_homing() noexcept {
  for (int i = 0; i < robot_.count(); ++i) {
    if (robot_.axes[i].state() == AxisState::ErrorStop) {
      trip(ErrorCode::NotHomed, i + 1, 1);
      return;
    }
  }
  if (robot_.axes.all_homed()) {
    come_to_standby();
    finish_service(ErrorCode::Ok);
  }
}

void Group::run_motion(Signals& signals) noexcept {
  if (by_hand_.guiding.on()) {
    by_hand_.guiding.move(gate_);
    return;
  }
  if (robot_.job.running()) {
    if (!run_job(signals)) {
      return;
    }
  } else if (!queue_.empty()) {
    queue_.feed();
    begin_next(false);
  }
  take_plan();
  if (!job_motions_.step_push()) {
    follow_path();
  }
  if (robot_.states.moving()) {
    queue_.note_progress();
  }
  if (robot_.states.moving()) {
    end_motions();
  }
}

// Returns false if the job has paused.
bool Group::run_job(Signals& signals) noexcept {
  JobRunner& job = robot_.job;
  const int before = plans_.ahead().count();
  job.step(robot_.period, signals, job_motions_);
  if (job.state() == JobState::Failed) {
    stops_.stop_for_job();
  } else if (job.state() == JobState::Paused) {
    resuming_.pause();
    return false;
  }
  begin_next(plans_.ahead().count() > before);
  return true;
}

void Group::begin_next(bool more) noexcept {
  // Chains are few and reused, so none is begun while an abandoned one is still being checked.
  if (!robot_.states.moving() || shelf_.leaving() || !plans_.can_plan() || plans_.holds_forgotten()) {
    return;
  }
  const Joints from = correction_.shifts() ? robot_.follower.end() : conveyor_.planned_end();
  const ReadAhead::Next next = plans_.begin_next(from, more);
  if ((next.chain != nullptr && next.lines == nullptr) || next.joint_path != nullptr) {
    resuming_.forget_steps();
  } else if (next.chain == nullptr && next.command != nullptr) {
    resuming_.note(*next.command, from);
  }
}

void Group::take_plan() noexcept {
  const Plan* plan = plans_.take();
  if (plan == nullptr) {
    return;
  }
  if (plan->fault.code == ErrorCode::Planner) {
    break_down("the thread that plans motions", plans_.desk().crash());
  } else if (plan->fault.code != ErrorCode::OtherRobot && !plan->fault.ok() && resuming_.try_joints()) {
    return;
  } else if (!plan->fault.ok()) {
    motion_failed(plan->fault, plan->segment.source, plan->segment.ticket);
  } else {
    note_lines(*plan);
  }
}

// How lines with zones are followed is known when they have been planned.
void Group::note_lines(const Plan& plan) noexcept {
  const PlanRequest& asked = plans_.request();
  if (plan.parts) {
    resuming_.note(asked.command, asked.from);
  } else if (plan.segment.chain != nullptr && plan.segment.chain == asked.lines) {
    if (asked.lines->crowded()) {
      resuming_.forget_steps();
    } else {
      resuming_.note(*asked.lines, asked.command.acceleration, asked.from);
    }
  }
}

void Group::motion_failed(const Fault& fault, int source, std::uint32_t ticket) noexcept {
  JobRunner& job = robot_.job;
  const bool by_job = job.running();
  FaultText why;
  describe(fault, robot_.tool.places().clearance(), why);
  if (fault.code == ErrorCode::OtherRobot) {
    std::snprintf(why, sizeof why, "%s", space_.text());
  }
  if (fault.code == ErrorCode::Unreachable || fault.code == ErrorCode::JointLimit) {
    const PlanRequest& asked = plans_.request();
    const Target& target = asked.command.target;
    const Joints end = asked.chain != nullptr ? asked.from
                       : target.is_pose       ? with_axes(target.held, target.joints, asked.from)
                                              : target.joints;
    add_workpiece(robot_.tool.arm(), end, why);
  }
  if (source < 0) {
    queue_.fail(source, fault.code);
    job.set_message(why);
    return;
  }
  if (source > 0 && job.recover(fault, why, source, ticket)) {
    plans_.ahead().clear();  // the next one begins where the motion before it ends
    resuming_.forget_steps();
    return;
  }
  job.fail(fault, why, source);
  if (!by_job && fault.pair >= 0) {
    job.set_message(why);
  }
  finish_service(Fault{fault.code, fault.axis});
  resuming_.cancel_way_back();
  if (by_hand_.jogging.on()) {
    by_hand_.jogging.try_shorter();
  } else if (by_job) {
    stop_for(fault);
  }
}

void Group::follow_path() noexcept {
  Follower& follower = robot_.follower;
  AxisRow& axes = robot_.axes;
  Fault fault = follower.step(robot_.period);
  Joints q = follower.joints();
  fault = fault.ok() ? conveyor_.carry(q) : fault;
  fault = fault.ok() ? correction_.shift(q) : fault;
  if (!fault.ok()) {
    if (by_hand_.jogging.on() && axes.gates_at_rest() && robot_.states.moving()) {
      follower.reset(robot_.commanded());  // an axis at its limit may have no first step
      by_hand_.jogging.block();
      return;
    }
    fall_off(fault.code, fault.axis);
    return;
  }
  const Joints speed = (q - axes.last()) / robot_.period;
  for (int i = 0; i < robot_.count(); ++i) {
    if (robot_.states.to_error() && !axes[i].in_group()) {
      continue;  // its drive has no power, so it stays where it is
    }
    axes[i].follow({q[i], speed[i], (speed[i] - axes.last_speed()[i]) / robot_.period});
  }
}

// The state after the last motion, or the way from a way back to what follows it.
void Group::end_motions() noexcept {
  if (!settled()) {
    return;
  }
  if (resuming_.way_back() == Resuming::Return::FromInterrupt) {
    if (resuming_.may_continue(shelf_.path())) {
      shelf_.end_come_back();
    }
  } else if (resuming_.way_back() != Resuming::Return::None) {
    if (resuming_.way_back() == Resuming::Return::Back || resuming_.may_continue(robot_.follower.kept_path())) {
      resuming_.end_way_back();
    }
  } else if (!robot_.job.running() && queue_.empty() && !conveyor_.on() && !robot_.states.pressing()) {
    come_to_standby();
    finish_service(robot_.states.error());
  }
}

}  // namespace indurop::robot
