// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/group.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace indurop::robot {

namespace {

constexpr double kPowerTime = 4;    // s within which all drives must have power or have left a fault
constexpr double kLetGoTime = 0.5;  // s to wait for drives to switch off; one that stays on is used as it is
AxisControl::Scale scale_of(const Settings& settings, const Axis& axis, std::size_t i) noexcept {
  const auto own = [i](const std::vector<double>& values) { return values.size() > 1 ? values[i] : values[0]; };
  const double unit = axis.slides() ? 0.001 : kPi / 180;
  const double counts = axis.slides() ? own(settings.counts_per_mm) * 1000 : own(settings.counts_per_turn) / (2 * kPi);
  return {counts, own(settings.gear), unit, own(settings.zero) * unit};
}

}  // namespace

Group::Group(GroupParts parts)
    : parts_(std::move(parts)),
      tools_(parts_.arm, parts_.book.tips()),
      dynamics_(parts_.dynamics),
      places_(tools_.arm(0), tools_.inverse(0), Workspace::of(parts_.settings.workspace), parts_.clearance),
      follower_(places_, parts_.joints),
      job_(parts_.book),
      ahead_(places_, parts_.tool),
      desk_(places_, parts_.joints, parts_.tool, parts_.settings),
      loader_(parts_.settings, parts_.urdf),
      brake_(parts_.joints),
      clear_(places_.clearance(), false),
      to_rest_(places_.clearance(), false),
      shelf_(std::make_unique<Shelf>(places_, parts_.tool)) {
  set_up_torques();
  const Settings& settings = parts_.settings;
  period_ = std::chrono::duration<double>(settings.period).count();
  belts_.fill(BeltWatch(period_));
  tracking_ = Tracking(period_);
  for (int i = 0; i < count(); ++i) {
    const LineLimits limits{parts_.joints.velocity[i], parts_.joints.acceleration[i], parts_.joints.jerk[i]};
    const Axis& axis = parts_.arm.axis(i);
    axes_[at(i)].set_up(axis, limits, scale_of(settings, axis, at(i)), settings.absolute, &table_,
                        {axes(), {gates_.data(), axis_count()}, cams_, &profiles_, i});
    axes_[at(i)].allow_torque(most_torque(i));
    gates_[at(i)] = SetPointGate({axis.lower, axis.upper, axis.endless}, limits, period_);
  }
}

bool Group::all_enabled() const noexcept {
  return std::all_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.drive().enabled(); });
}

bool Group::powered() const noexcept {
  return state_ != GroupState::Disabled && state_ != GroupState::ErrorStop;
}

Joints Group::commanded() const noexcept {
  Joints q = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    q[i] = axes_[at(i)].commanded().position;
  }
  return q;
}

void Group::step(const Inputs& in, Signals& signals, Outputs& out) noexcept {
  sense(in);
  watch(in);
  watch_contact(in);
  serve_mode(in.mode);
  serve_commands(in);
  if (in.requests_known) {
    serve(in.service, in.edit);
    for (int i = 0; i < count(); ++i) {
      axes_[at(i)].serve(in.axes[at(i)], axis_permit());
    }
  }
  serve_jog(in.jog);
  set_pace(in);
  job_.watch(in.single_step, in.breakpoints);
  desk_.expect_work(powered());
  run_state(signals);
  pass_gates();
  for (int i = 0; i < count(); ++i) {
    out.drives[at(i)] = axes_[at(i)].command(in.drives[at(i)], quick_stop_);
  }
  feed_torques(out);
  report(out);
}

void Group::sense(const Inputs& in) noexcept {
  for (int i = 0; i < count(); ++i) {
    axes_[at(i)].sense(in.drives[at(i)], period_);
  }
  emergency_ = in.emergency;
  for (AxisControl& a : axes()) {
    a.set_stops(emergency_, to_error_);
  }
  sense_belts(in);
}

// Monitors what may end a motion from outside: the emergency stop, drives, axes that do not follow.
void Group::watch(const Inputs& in) noexcept {
  if (in.emergency && !stopped_for_emergency() && commands_motion()) {
    trip(ErrorCode::Emergency, 0, parts_.settings.emergency_factor);
    return;
  }
  if (!powered()) {
    fail_axes_behind();
    return;
  }
  if (to_error_) {
    return;
  }
  for (int i = 0; i < count(); ++i) {
    const Drive::State drive = Drive::state_of(in.drives[at(i)].status);
    if (drive != Drive::State::OperationEnabled || axes_[at(i)].power_falls()) {
      const bool fault = drive == Drive::State::Fault || drive == Drive::State::FaultReaction;
      trip(fault ? ErrorCode::Drive : ErrorCode::Power, i + 1, 1);
      return;
    }
  }
  if (const int behind = state_ == GroupState::Homing ? -1 : axis_behind(); behind >= 0) {
    trip(ErrorCode::Following, behind + 1, 1);
  }
}

// Describes a fault in words; for a collision also the pair of bodies and the place on the path.
void Group::describe(Fault fault, char (&to)[kWhy]) const noexcept {
  if (fault.pair < 0) {
    std::snprintf(to, sizeof to, "%s", to_string(fault.code));
    return;
  }
  char pair[kWhy];
  places_.clearance().name(fault.pair, pair, sizeof pair);
  if (fault.part < 0) {
    std::snprintf(to, sizeof to, "%.*s would touch", kWhy - 40, pair);
  } else {
    std::snprintf(to, sizeof to, "%.*s would touch, after %.0f %% of the way", kWhy - 40, pair, 100 * fault.part);
  }
}

void Group::motion_failed(Fault fault, int source, std::uint32_t ticket) noexcept {
  if (source < 0) {
    fail_motions(-source - 1, fault.code);
    return;
  }
  const bool job = job_.running();
  char why[kWhy];
  describe(fault, why);
  if (source > 0 && job_.recover(fault, why, source, ticket)) {
    ahead_.clear();  // the next one begins where the motion before it ends
    passed_known_ = 0;
    return;
  }
  job_.fail(fault, why, source);
  if (!job && fault.pair >= 0) {
    job_.say(why);
  }
  finish_service(fault.code, fault.axis);
  return_ = Return::None;
  if (jogging_) {
    jog_shorter();
    return;
  }
  if (job) {
    stop_for(fault);
  }
}

void Group::run_state(Signals& signals) noexcept {
  job_.end_pulses(period_, signals);
  run_reload(signals);
  weigh_pushing();
  move_axes();
  switch (state_) {
    case GroupState::Disabled:
      go_on_resetting();
      run_enabling();
      break;
    case GroupState::Standby:
    case GroupState::ErrorStop:
      follower_.reset(commanded());
      go_on_resetting();
      break;
    case GroupState::Homing:
      run_homing();
      break;
    case GroupState::Moving:
      run_motion(signals);
      break;
    case GroupState::Stopping:
      run_stopping();
      break;
  }
}

void Group::come_to_standby() noexcept {
  state_ = GroupState::Standby;
  on_path_ = true;
  job_moves_ = false;
  interrupted_ = false;
  end_interrupt(ErrorCode::Ok);
  jogging_ = false;
  for (AxisControl& a : axes()) {
    if (a.in_group()) {
      a.rest();
      a.reset();
    }
  }
}

bool Group::lets_go() const noexcept {
  return std::any_of(axes().begin(), axes().end(),
                     [](const AxisControl& a) { return a.drive().enabled() && !a.wants_power(); });
}

void Group::take_power() noexcept {
  for (AxisControl& a : axes()) {
    a.power(true);
  }
}

void Group::run_enabling() noexcept {
  if (!enabling_) {
    return;
  }
  waited_ += period_;
  if (letting_go_) {
    letting_go_ = lets_go() && waited_ <= kLetGoTime;
    letting_go_ ? void() : take_power();
  } else if (all_enabled()) {
    enabling_ = false;
    come_to_standby();
    finish_service(ErrorCode::Ok);
  } else if (waited_ > kPowerTime) {
    enabling_ = false;
    int late = 0;
    while (late < count() - 1 && axes_[at(late)].drive().enabled()) {
      ++late;
    }
    for (AxisControl& a : axes()) {
      a.power(false);
    }
    finish_service(axes_[at(late)].drive().faulty() ? ErrorCode::Drive : ErrorCode::Power, late + 1);
  }
}

void Group::run_homing() noexcept {
  for (int i = 0; i < count(); ++i) {
    if (axes_[at(i)].state() == AxisState::ErrorStop) {
      trip(ErrorCode::NotHomed, i + 1, 1);
      return;
    }
  }
  const bool all = std::all_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.homed(); });
  if (all) {
    come_to_standby();
    finish_service(ErrorCode::Ok);
  }
}

void Group::follow_path() noexcept {
  Fault fault = follower_.step(period_);
  Joints q = follower_.joints();
  fault = fault.ok() ? ride(q) : fault;
  if (!fault.ok()) {
    const bool stands = std::all_of(gates_.begin(), gates_.end(), [](const SetPointGate& g) { return g.at_rest(); });
    if (jogging_ && stands && state_ == GroupState::Moving) {
      follower_.reset(commanded());  // an axis at its limit may have no first step
      jog_blocked_ = true;
      return;
    }
    fall_off(fault.code, fault.axis);
    return;
  }
  const Joints speed = (q - last_command_) / period_;
  for (int i = 0; i < count(); ++i) {
    if (to_error_ && !axes_[at(i)].in_group()) {
      continue;  // its drive has no power, so it stays where it is
    }
    axes_[at(i)].follow({q[i], speed[i], (speed[i] - last_speed_[i]) / period_});
  }
}

void Group::run_motion(Signals& signals) noexcept {
  if (job_.running()) {
    const int before = ahead_.count();
    job_.step(period_, signals, *this);
    if (job_.state() == JobState::Failed) {
      const Fault fault = job_.fault();
      finish_service(fault.code, fault.axis);
      stop_for(fault);
    } else if (job_.state() == JobState::Paused) {
      pause_job();
      return;
    }
    begin_next(ahead_.count() > before);
  } else if (motion_count_ > 0) {
    feed_motions();
    begin_next(false);
  }
  take_plan();
  follow_path();
  if (state_ == GroupState::Moving) {
    note_progress();
  }
  if (state_ == GroupState::Moving && settled() && return_ != Return::None) {
    end_return();
  } else if (state_ == GroupState::Moving && settled() && !job_.running() && motion_count_ == 0 && !tracking_.on()) {
    come_to_standby();
    finish_service(error_);
  }
}

}  // namespace indurop::robot
