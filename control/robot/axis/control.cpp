// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/control.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace indurop::robot {

namespace {

constexpr double kHomeTime = 120;  // s

std::int32_t counts(double value) noexcept {
  constexpr double kMaxCounts = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::llround(std::clamp(value, -kMaxCounts, kMaxCounts)));
}

}  // namespace

void AxisControl::set_up(const Axis& axis, const LineLimits& limits, const Scale& scale, bool absolute,
                         CommandTable* table, const Row& row) noexcept {
  least_ = axis.lower;
  greatest_ = axis.upper;
  endless_ = axis.endless;
  most_ = limits;
  own_ = {axis.lower, axis.upper, true, true, limits.velocity, limits.acceleration, limits.acceleration, limits.jerk};
  keep_ends();
  scale_ = scale;
  homed_ = absolute;
  table_ = table;
  row_ = row;
}

LineLimits AxisControl::limits(double hardness) const noexcept {
  return {most_.velocity, most_.acceleration * hardness, most_.jerk * hardness * hardness};
}

void AxisControl::sense(const DriveIn& in, double seconds) noexcept {
  sense_probe(in);
  watch_mode(in, seconds);
  led_by_drive_ = false;
  const double before = measured_;
  measured_ = in.position / scale_.counts + scale_.zero;
  measured_speed_ = sensed_ ? (measured_ - before) / seconds : 0;
  sensed_ = true;
  placed_anew_ = state_ == AxisState::Homing;
  if (Drive::state_of(in.status) != Drive::State::OperationEnabled) {
    const bool moved = busy();
    put({measured_, 0, 0});  // the commanded position of a drive without power is where it is
    placed_anew_ = true;
    if (moved) {
      fail(ErrorCode::Drive, 1);
    } else if (state_ == AxisState::Standstill && want_power_) {
      const Drive::State drive = Drive::state_of(in.status);
      const bool fault = drive == Drive::State::Fault || drive == Drive::State::FaultReaction;
      fail(fault ? ErrorCode::Drive : ErrorCode::Power, 1);  // PLCopen: the axis leaves ErrorStop by a reset only
    } else if (state_ != AxisState::ErrorStop) {
      state_ = AxisState::Disabled;
      release_stop();
    }
  } else if (state_ == AxisState::Disabled) {
    state_ = AxisState::Standstill;
  }
}

bool AxisControl::busy() const noexcept {
  return state_ == AxisState::DiscreteMotion || state_ == AxisState::ContinuousMotion ||
         state_ == AxisState::Stopping || state_ == AxisState::Homing || coupled_;
}

void AxisControl::finish(Owner& owner, ErrorCode code) noexcept {
  if (owner.ticket == kNobody && code == ErrorCode::Ok) {
    return;
  }
  if (owner.ticket == kRequest) {
    (code == ErrorCode::Ok ? report_.done : report_.aborted) = report_.acknowledged;
  } else if (owner.ticket != kNobody && owner.ticket == power_ && code == ErrorCode::Ok) {
    table_->holds(owner.ticket);
  } else if (owner.ticket != kNobody) {
    power_ = owner.ticket == power_ ? kNobody : power_;
    table_->end(owner.ticket, code);
  }
  owner = {};
  // The reason for ErrorStop stays known.
  const bool keeps = code == ErrorCode::Aborted || (code == ErrorCode::Ok && state_ == AxisState::ErrorStop);
  report_.error = keeps ? report_.error : code;
}

void AxisControl::serve(const AxisRequest& request, ErrorCode permit) noexcept {
  if (first_) {
    // Requests from before this program started are not executed.
    first_ = false;
    report_.acknowledged = report_.aborted = request.number;
    return;
  }
  if (request.number == report_.acknowledged) {
    return;
  }
  for (Owner* owner : {&admin_, &motion_owner_, &super_}) {
    if (owner->ticket == kRequest) {
      finish(*owner, ErrorCode::Aborted);
    }
  }
  report_.acknowledged = request.number;
  const auto service = static_cast<AxisService>(request.code);
  if (permit != ErrorCode::Ok && service != AxisService::Reset && service != AxisService::PowerOn) {
    Owner owner{kRequest, service};
    finish(owner, permit);
    return;
  }
  report_.error = state_ == AxisState::ErrorStop ? report_.error : ErrorCode::Ok;
  Command command;
  command.code = request.code;
  command.to[0] = request.position;
  command.velocity = request.velocity;
  command.acceleration = request.acceleration;
  command.jerk = request.jerk;
  order(kRequest, command);
}

void AxisControl::home() noexcept {
  state_ = AxisState::Homing;
  homed_ = false;
  waited_ = 0;
  drive_.home(true);
}

void AxisControl::move_home(double seconds) noexcept {
  waited_ += seconds;
  const bool failed = drive_.home_failed() || waited_ > kHomeTime;
  if (!failed && !drive_.home_found()) {
    return;
  }
  drive_.home(false);
  homed_ = !failed;
  motion_.reset({measured_, 0, 0});
  if (failed) {
    abort_queue();
  }
  state_ = failed ? AxisState::ErrorStop : AxisState::Standstill;
  end_motion(failed ? ErrorCode::NotHomed : ErrorCode::Ok);
}

// A motion without a target must not run into the end of the axis: from its next position the axis must still be able
// to come to rest before the end.
void AxisControl::guard_limits(double seconds) noexcept {
  const LineState next = motion_.after(seconds);
  const double rest = next.position + ramp(next, 0, limits(1)).distance;
  const bool ends = !endless_ && ((next.velocity > 0 && rest > upper_ - kEndMargin) ||
                                  (next.velocity < 0 && rest < lower_ + kEndMargin));
  if (ends) {
    abort_queue();
    finish(motion_owner_, ErrorCode::JointLimit);
    motion_.stop(limits(1));
    state_ = AxisState::Stopping;
  }
}

void AxisControl::move(double seconds) noexcept {
  look_at_commands();
  keep_power();
  if (admin_.service == AxisService::PowerOn) {
    wait_for_power(seconds);
  }
  if (state_ == AxisState::Homing) {
    move_home(seconds);
    return;
  }
  advance(seconds);
  if (admin_.service == AxisService::PowerOff && motion_.at_rest()) {
    want_power_ = false;
    if (!drive_.enabled()) {
      finish(admin_, ErrorCode::Ok);
    }
  }
  if (admin_.service == AxisService::Reset) {
    wait_for_reset(seconds);
  }
  const bool goes_on = state_ == AxisState::ContinuousMotion;
  report_.in_velocity = goes_on && !push_.on() && motion_.done();
  note_superimposed();
  if (goes_on || coupled_) {
    note_velocity();
  } else if (over_) {
    return;
  } else if (state_ == AxisState::DiscreteMotion && motion_.at_rest()) {
    state_ = AxisState::Standstill;
    end_motion(ErrorCode::Ok);
  } else if (state_ == AxisState::Stopping && motion_.at_rest()) {
    finish(motion_owner_, ErrorCode::Ok);
    if (stop_ != kNobody && table_->execute(stop_)) {
      table_->holds(stop_);
    } else {
      state_ = AxisState::Standstill;
      release_stop();
    }
  }
}

// For motions without an end: the request ends when the velocity is reached, the command when another one takes over.
void AxisControl::note_velocity() noexcept {
  const bool reached = coupled_ ? coupling_.synced() : push_.on() ? push_.reached() : report_.in_velocity;
  if (motion_owner_.ticket == kRequest && reached && !coupled_) {
    finish(motion_owner_, ErrorCode::Ok);
  } else if (motion_owner_.ticket != kNobody && motion_owner_.ticket != kRequest) {
    table_->reached(motion_owner_.ticket, reached);
  }
  if (reached && queued_ > 0) {
    end_motion(ErrorCode::Aborted);
  }
}

void AxisControl::follow(const LineState& state) noexcept {
  put(state);
  release_stop();
  state_ = AxisState::SynchronizedMotion;
}

void AxisControl::fail(ErrorCode code, double hardness) noexcept {
  if (admin_.ticket == power_) {
    admin_ = {};  // continues once it has been reset
  } else if (admin_.service != AxisService::Reset) {
    finish(admin_, code);
  }
  finish(motion_owner_, code);
  finish(super_, code);
  abort_queue();
  release_stop();
  drive_.home(false);
  let_go();
  if (!motion_.at_rest()) {
    motion_.stop(limits(hardness));
  }
  state_ = AxisState::ErrorStop;
}

DriveOut AxisControl::command(const DriveIn& in, bool quick_stop) noexcept {
  quick_stopped_ = quick_stop && state_ == AxisState::ErrorStop;
  drive_.step(in, quick_stopped_ ? Drive::Want::QuickStop : want_power_ ? Drive::Want::On : Drive::Want::Off);
  DriveOut out;
  out.control = drive_.control();
  out.mode = drive_.mode();
  out.position = counts((commanded().position - scale_.zero) * scale_.counts * scale_.gear);
  out.probe = probe_.function();
  return out;
}

AxisReport AxisControl::report() const noexcept {
  AxisReport report = report_;
  report.state = state_;
  report.power = drive_.enabled() && admin_.service != AxisService::PowerOn;
  report.homed = homed_;
  report.position = (measured_ - origin_) / scale_.unit;
  report.command = (commanded().position - origin_) / scale_.unit;
  report.acceleration = commanded().acceleration / scale_.unit;
  report.measured_velocity = measured_speed_ / scale_.unit;
  report.lower = (least_ - origin_) / scale_.unit;
  report.upper = (greatest_ - origin_) / scale_.unit;
  report_own(report);
  report.most_velocity = most_.velocity / scale_.unit;
  report.most_acceleration = most_.acceleration / scale_.unit;
  report.most_jerk = most_.jerk / scale_.unit;
  report.velocity = commanded().velocity / scale_.unit;
  report.phase = coupled_ ? coupling_.phase() / row_.axes[static_cast<std::size_t>(leaders_[0].axis)].scale_.unit : 0;
  return report;
}

}  // namespace indurop::robot
