// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/group.h"

#include <utility>

namespace indurop::robot {

Group::Group(GroupParts parts)
    : robot_(std::move(parts)),
      correction_(robot_),
      space_(robot_),
      ways_(robot_),
      plans_(robot_, correction_, space_, ways_),
      mode_(robot_),
      torques_(robot_, *this),
      resuming_(robot_, *this, plans_, correction_),
      shelf_(robot_, *this, plans_, resuming_),
      conveyor_(robot_, *this, plans_),
      queue_(robot_, *this, plans_, conveyor_),
      by_hand_{{robot_, *this, plans_}, {robot_, *this, torques_}},
      gate_(robot_, *this, mode_, space_, {conveyor_, correction_, by_hand_.guiding}),
      power_(robot_, *this, torques_),
      stops_(robot_, *this, gate_, {conveyor_, correction_, by_hand_.guiding}, power_),
      job_motions_(robot_, plans_, resuming_, shelf_, torques_, {conveyor_, correction_, by_hand_.guiding}),
      services_(robot_, *this,
                {plans_, resuming_, conveyor_, by_hand_.guiding, queue_, mode_, stops_, power_, job_motions_}),
      service_(robot_, *this, plans_, services_),
      answers_(robot_.job),
      overrides_(robot_, *this, conveyor_, correction_),
      commands_(robot_, *this, service_, queue_, {conveyor_, overrides_.sync(), stops_, job_motions_}),
      reloading_(robot_, *this, plans_, gate_.clear(), torques_),
      breakdown_(robot_, *this),
      motion_report_(robot_, conveyor_) {
  space_.set_left(shelf_.paths());
  ways_.set_left(shelf_.paths());
  begin_keeping();
}

void Group::step(const Inputs& in, Signals& signals, Outputs& out) noexcept {
  sense(in);
  watch(in);
  torques_.step(in);
  if (const ErrorCode code = mode_.step(in.mode); code != ErrorCode::Ok) {
    stops_.stop_for_mode(code);
    robot_.single.halt();
  }
  commands_.serve(in, mode_);
  if (in.requests_known) {
    service_.serve(in.service, in.edit);
    for (int i = 0; i < robot_.count(); ++i) {
      robot_.axes[i].serve(in.axes[at(i)], mode_.axis_permit());
    }
    robot_.single.serve(in, mode_.permit());
  }
  answers_.serve(in.answer);
  by_hand_.jogging.step(in.jog, mode_.permits_jogging());
  by_hand_.guiding.step(in, mode_);
  overrides_.step(in, queue_.interrupted(), mode_, by_hand_.jogging.on());
  robot_.job.set_pauses(in.single_step, in.breakpoints);
  plans_.expect_work(robot_.states.powered());
  run_state(signals);
  gate_.pass();
  for (int i = 0; i < robot_.count(); ++i) {
    out.drives[at(i)] = robot_.axes[i].command(in.drives[at(i)], power_.quick_stop());
  }
  torques_.feed(out);
  robot_.single.step(in, out, overrides_.sync().on());
  report(out);
}

void Group::sense(const Inputs& in) noexcept {
  for (int i = 0; i < robot_.count(); ++i) {
    robot_.axes[i].sense(in.drives[at(i)], robot_.period);
  }
  robot_.states.set_emergency(in.emergency);
  for (AxisControl& a : robot_.axes) {
    a.set_stops(in.emergency, robot_.states.to_error());
  }
  robot_.single.sense(in);
  conveyor_.sense(in.belts);
}

// Returns whether all axes are stopped for the emergency; axes that were reset one by one are stopped again.
bool Group::stopped_for_emergency() const noexcept {
  return robot_.states.error() == ErrorCode::Emergency && (robot_.states.to_error() || robot_.axes.all_failed());
}

// Monitors what may end a motion from outside: the emergency stop, drives, axes that do not follow.
void Group::watch(const Inputs& in) noexcept {
  const bool held = in.hold || !(in.speed_override / 100 >= Follower::kStill);
  const bool intruded = space_.sense(in.others, in.tick, held);
  if (in.emergency && !stopped_for_emergency() && commands_motion()) {
    trip(ErrorCode::Emergency, 0, robot_.parts.settings.emergency_factor);
    return;
  }
  if (!robot_.states.powered()) {
    robot_.axes.fail_behind();
    return;
  }
  if (robot_.states.to_error()) {
    return;
  }
  if (intruded && !robot_.axes.gates_at_rest()) {
    trip(ErrorCode::OtherRobot, 0, robot_.parts.settings.emergency_factor, space_.text());
    return;
  }
  for (int i = 0; i < robot_.count(); ++i) {
    const Drive::State drive = Drive::state_of(in.drives[at(i)].status);
    if (drive != Drive::State::OperationEnabled || robot_.axes[i].power_falls()) {
      const bool fault = drive == Drive::State::Fault || drive == Drive::State::FaultReaction;
      trip(fault ? ErrorCode::Drive : ErrorCode::Power, i + 1, 1);
      return;
    }
  }
  if (const int behind = robot_.states.is(GroupState::Homing) ? -1 : robot_.axes.first_behind(); behind >= 0) {
    trip(ErrorCode::Following, behind + 1, 1);
  }
}

void Group::trip(ErrorCode code, int axis, double hardness, const char* why) noexcept {
  stops_.trip(code, axis, hardness, why);
}

void Group::forget_plans() noexcept {
  queue_.drop(ErrorCode::Aborted);
  queue_.end_interrupt(ErrorCode::Aborted);
  plans_.forget();
  resuming_.cancel_way_back();
  if (!resuming_.aside()) {
    plans_.ahead().clear();
  }
}

void Group::set_job_aside() noexcept {
  // What a belt carries cannot be resumed: by then it is elsewhere.
  if (robot_.job.running() && !conveyor_.on() && !shelf_.set_job_aside()) {
    resuming_.set_aside();
  }
}

void Group::drop_aside() noexcept {
  resuming_.drop();
  plans_.ahead().clear();
  shelf_.drop();
}

void Group::end_motion() noexcept {
  correction_.stand();
  static_cast<void>(job_motions_.step_push());  // an axis that pushed for a job rests now
  robot_.states.end_motion();
  queue_.end_interrupt(ErrorCode::Ok);
  by_hand_.jogging.end();
  by_hand_.guiding.end();
  robot_.axes.end_group_motion();
}

void Group::come_to_standby() noexcept {
  robot_.states.stand_by();
  end_motion();
}

bool Group::commands_motion() const noexcept {
  return !robot_.states.is(GroupState::Disabled) || power_.enabling() || robot_.axes.any_wants_power();
}

void Group::report(Outputs& out) noexcept {
  const GroupStates& states = robot_.states;
  out.state = states.state();
  out.busy = service_.active() || states.busy();
  service_.report(out);
  out.moving_by_job = states.moving_by_job();
  out.error = states.error();
  out.error_axis = static_cast<std::uint32_t>(states.error_axis());
  out.mode = mode_.mode();
  out.guided = by_hand_.guiding.on();
  out.may_move = mode_.permit() == ErrorCode::Ok;
  out.tool = static_cast<std::uint32_t>(robot_.tool.number());
  out.tool_name = robot_.tool.tool().name.c_str();
  out.job = robot_.job.report(job_motions_.progress());
  answers_.report(out.job.question);
  if (overrides_.wrong()) {
    out.job.message = "ROBOT_OVERRIDE or MC_FACTORS is below 0 or no number, so the robot holds: correct it";
  }
  out.job.can_resume = resuming_.aside() && !states.moving();
  for (int i = 0; i < kAxes; ++i) {
    out.axes[at(i)] = robot_.axes[i].report();
  }
  torques_.report(out);
  out.commands = robot_.table.answers();
  breakdown_.report(out);
  out.space = space_.report();
  ways_.report(!conveyor_.on(), out);
  conveyor_.update_product();
  motion_report_.report(commands_motion(), out);
  robot_.single.report(out);
}

}  // namespace indurop::robot
