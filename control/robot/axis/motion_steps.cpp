// SPDX-License-Identifier: Apache-2.0
// One period of the motions of a single axis, and what ends them.

#include "control/robot/axis/control.h"
#include "control/robot/axis/motions.h"

namespace indurop::robot {

namespace {

constexpr double kHomeTime = 120;  // s

}  // namespace

void AxisMotions::step_home(double seconds) noexcept {
  homing_ += seconds;
  const bool failed = parts_.drive.home_failed() || homing_ > kHomeTime;
  if (!failed && !parts_.drive.home_found()) {
    return;
  }
  parts_.drive.home(false);
  parts_.homed = !failed;
  parts_.motion.reset({parts_.measured.position, 0, 0});
  if (failed) {
    queue_.abort(answers_.table());
  }
  parts_.state = failed ? AxisState::ErrorStop : AxisState::Standstill;
  end_motion(failed ? ErrorCode::NotHomed : ErrorCode::Ok);
}

// Advances by one period, whichever motion sets the target.
void AxisMotions::step(double seconds) noexcept {
  const bool rests = parts_.motion.at_rest() && !parts_.following.leaving();
  if (const ErrorCode code = parts_.pushing.prepare(parts_.drive, rests, seconds); code != ErrorCode::Ok) {
    stop_with(code);
  }
  if (parts_.pushing.pushes()) {
    step_torque(seconds);
    return;
  }
  if (parts_.following.coupled()) {
    step_coupled(seconds);
  } else if (!parts_.following.leaving()) {
    step_own(seconds);
  }
  if (!parts_.following.leaving()) {
    return;
  }
  parts_.following.step_leaving(parts_.row.own_gate(), seconds);
  parts_.motion.lend(parts_.following.state());
  if (!parts_.following.leaving()) {
    parts_.motion.go_on();
    step_own(seconds);
  }
}

void AxisMotions::step_coupled(double seconds) noexcept {
  if (const ErrorCode code = parts_.following.step(parts_.row, seconds); code != ErrorCode::Ok) {
    stop_with(code);
  } else {
    parts_.motion.lend(parts_.following.state());
  }
}

void AxisMotions::step_own(double seconds) noexcept {
  if (const ErrorCode code = guard(seconds); code != ErrorCode::Ok) {
    stop_own(code);
  }
  parts_.motion.step(seconds);
  // A motion that passes its end continues with the next one in the same period, several times if they are short.
  for (int i = 0; parts_.motion.passed() && i < CommandTable::kMaxCommands; ++i) {
    const double rest = parts_.motion.rest_of_step();
    end_motion(ErrorCode::Ok);
    parts_.motion.step(rest);
  }
  if (parts_.following.over()) {
    step_over(seconds);
  }
}

void AxisMotions::step_over(double seconds) noexcept {
  const ErrorCode code = parts_.following.step_over(parts_.motion.state(), parts_.row.own_gate(), seconds);
  if (code != ErrorCode::Ok) {
    superimposed_.end(code);
    stop_with(code);
  }
}

// The set point is the position that the axis will have when the drive takes it.
void AxisMotions::step_torque(double seconds) noexcept {
  const TorqueMode::Measured& now = parts_.measured;
  const ErrorCode code = parts_.pushing.step(now, parts_.bounds, parts_.units.resolution(), seconds);
  parts_.motion.lend({parts_.pushing.ahead(now, seconds), now.speed, 0});
  if (code != ErrorCode::Ok) {
    stop_with(code);
  }
}

// Checks whether the axis' own motion may go on. A table is locked to time: an override or a hold ends it. A motion
// without a target must not run into the end of the axis: from its next position the axis must still be able to come to
// rest before the end.
ErrorCode AxisMotions::guard(double seconds) const noexcept {
  if (parts_.motion.along() && !parts_.motion.full_speed()) {
    return ErrorCode::State;
  }
  const AxisBounds& bounds = parts_.bounds;
  if (parts_.state != AxisState::ContinuousMotion) {
    return ErrorCode::Ok;
  }
  const LineState next = parts_.motion.after(seconds);
  const double rest = next.position + ramp(next, 0, bounds.limits(1)).distance;
  const bool ends =
      (next.velocity > 0 && bounds.beyond_upper(rest)) || (next.velocity < 0 && bounds.beyond_lower(rest));
  return ends ? ErrorCode::JointLimit : ErrorCode::Ok;
}

// Ends the axis' own motion; a superimposed one continues.
void AxisMotions::stop_own(ErrorCode code) noexcept {
  queue_.abort(answers_.table());
  answers_.finish(owner_, code);
  parts_.motion.stop(parts_.bounds.limits(1));
  parts_.state = AxisState::Stopping;
}

void AxisMotions::note_ends() noexcept {
  const bool goes_on = parts_.state == AxisState::ContinuousMotion;
  answers_.report().in_velocity = goes_on && !parts_.pushing.on() && parts_.motion.done();
  note_superimposed();
  if (goes_on || parts_.following.coupled()) {
    note_velocity();
  } else if (!parts_.following.over() && parts_.motion.at_rest()) {
    note_rest();
  }
}

void AxisMotions::note_rest() noexcept {
  if (parts_.state == AxisState::DiscreteMotion) {
    parts_.state = AxisState::Standstill;
    end_motion(ErrorCode::Ok);
  } else if (parts_.state == AxisState::Stopping) {
    answers_.finish(owner_, ErrorCode::Ok);
    if (stop_ != AxisOwner::kNone && answers_.table().execute(stop_)) {
      answers_.table().holds(stop_);
    } else {
      parts_.state = AxisState::Standstill;
      release_stop();
    }
  }
}

// For motions without an end: the request ends when the velocity is reached, the command when another one takes over.
void AxisMotions::note_velocity() noexcept {
  const bool coupled = parts_.following.coupled();
  bool reached = answers_.report().in_velocity;
  if (coupled) {
    reached = parts_.following.synced();
  } else if (parts_.pushing.on()) {
    reached = parts_.pushing.reached();
  }
  if (owner_.is_request() && reached && !coupled) {
    answers_.finish(owner_, ErrorCode::Ok);
  } else if (owner_.is_command()) {
    answers_.table().reached(owner_.ticket, reached);
  }
  if (reached && !queue_.empty()) {
    end_motion(ErrorCode::Aborted);
  }
}

// The superimposed motion has ended; if nothing moves any more, the axis rests where both have led.
void AxisMotions::note_superimposed() noexcept {
  superimposed_.note();
  AxisFollowing& following = parts_.following;
  const bool discrete = parts_.state == AxisState::DiscreteMotion;
  if (!following.over() || !(discrete || parts_.state == AxisState::Stopping) || !parts_.motion.at_rest()) {
    return;
  }
  if (discrete && owner_.any()) {
    end_motion(ErrorCode::Ok);
  }
  if (following.synced()) {
    following.end_superimposed();
    parts_.motion.reset({following.state().position, 0, 0});
    parts_.state = discrete ? AxisState::Standstill : parts_.state;
  }
}

}  // namespace indurop::robot
