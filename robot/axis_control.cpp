// SPDX-License-Identifier: Apache-2.0
#include "robot/axis_control.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace indurop::robot {

namespace {

constexpr double kPowerTime = 3;   // s a drive may take to get power or to leave a fault
constexpr double kHomeTime = 120;  // s

std::int32_t counts(double value) noexcept {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::llround(std::clamp(value, -kMost, kMost)));
}

}  // namespace

void AxisControl::set_up(const Axis& axis, const LineLimits& limits, const Scale& scale, bool absolute) noexcept {
  lower_ = axis.lower;
  upper_ = axis.upper;
  endless_ = axis.endless;
  most_ = limits;
  scale_ = scale;
  homed_ = absolute;
}

LineLimits AxisControl::limits(double hardness) const noexcept {
  return {most_.velocity, most_.acceleration * hardness, most_.jerk * hardness * hardness};
}

void AxisControl::sense(const DriveIn& in) noexcept {
  measured_ = in.position / scale_.counts;
  placed_anew_ = state_ == AxisState::Homing;
  if (Drive::state_of(in.status) != Drive::State::OperationEnabled) {
    motion_.reset({measured_, 0, 0});  // a drive without power is where it is
    placed_anew_ = true;
    if (busy()) {
      fail(ErrorCode::Drive, 1);
    } else if (state_ != AxisState::ErrorStop) {
      state_ = AxisState::Disabled;
    }
  } else if (state_ == AxisState::Disabled) {
    state_ = AxisState::Standstill;
  }
}

bool AxisControl::busy() const noexcept {
  return state_ == AxisState::DiscreteMotion || state_ == AxisState::ContinuousMotion ||
         state_ == AxisState::Stopping || state_ == AxisState::Homing;
}

void AxisControl::finish(ErrorCode code) noexcept {
  if (active_) {
    (code == ErrorCode::Ok ? report_.done : report_.aborted) = report_.acknowledged;
  }
  active_ = false;
  report_.error = code == ErrorCode::Aborted ? report_.error : code;
}

void AxisControl::serve(const AxisRequest& request, bool group_moves) noexcept {
  if (first_) {
    // What was asked for before this program started is not done now.
    first_ = false;
    report_.acknowledged = report_.aborted = request.number;
    return;
  }
  if (request.number == report_.acknowledged) {
    return;
  }
  finish(ErrorCode::Aborted);
  report_.acknowledged = request.number;
  active_ = true;
  waited_ = 0;
  service_ = static_cast<AxisService>(request.code);
  if (group_moves && service_ != AxisService::Reset && service_ != AxisService::PowerOn) {
    finish(ErrorCode::State);
    return;
  }
  report_.error = state_ == AxisState::ErrorStop ? report_.error : ErrorCode::Ok;
  begin(request);
}

void AxisControl::begin(const AxisRequest& request) noexcept {
  ErrorCode code = ErrorCode::Ok;
  switch (service_) {
    case AxisService::None:
      finish(ErrorCode::Ok);
      return;
    case AxisService::PowerOn:
      code = state_ == AxisState::ErrorStop ? ErrorCode::State : ErrorCode::Ok;
      want_power_ = want_power_ || code == ErrorCode::Ok;
      break;
    case AxisService::PowerOff:
      motion_.stop(limits(1));
      break;
    case AxisService::Home:
      code = begin_home();
      break;
    case AxisService::MoveAbsolute:
    case AxisService::MoveRelative:
    case AxisService::MoveVelocity:
      code = begin_motion(request, service_);
      break;
    case AxisService::Stop:
      code = drive_.enabled() && state_ != AxisState::ErrorStop ? ErrorCode::Ok : ErrorCode::State;
      if (code == ErrorCode::Ok) {
        motion_.stop(limits(1));
        state_ = AxisState::Stopping;
      }
      break;
    case AxisService::Reset:
      if (state_ != AxisState::ErrorStop && !drive_.faulty()) {
        finish(ErrorCode::Ok);  // there is nothing to reset
      }
      return;
    default:
      code = ErrorCode::Opcode;
  }
  if (code != ErrorCode::Ok) {
    finish(code);
  }
}

ErrorCode AxisControl::begin_home() noexcept {
  if (!drive_.enabled() || state_ != AxisState::Standstill) {
    return ErrorCode::State;
  }
  home();
  return ErrorCode::Ok;
}

void AxisControl::home() noexcept {
  state_ = AxisState::Homing;
  homed_ = false;
  waited_ = 0;
  drive_.home(true);
}

ErrorCode AxisControl::begin_motion(const AxisRequest& request, AxisService service) noexcept {
  if (!drive_.enabled() || state_ == AxisState::ErrorStop || state_ == AxisState::Homing ||
      state_ == AxisState::Stopping) {
    return ErrorCode::State;
  }
  const auto chosen = [this](double wanted, double most) {
    return wanted == 0 ? most : std::min(wanted * scale_.unit, most);
  };
  const bool to_velocity = service == AxisService::MoveVelocity;
  const double speed = to_velocity ? std::abs(request.velocity) : request.velocity;
  if (!std::isfinite(request.position) || !(speed >= 0 && request.acceleration >= 0 && request.jerk >= 0) ||
      !std::isfinite(request.velocity)) {
    return ErrorCode::Value;
  }
  const LineLimits wanted{chosen(speed, most_.velocity), chosen(request.acceleration, most_.acceleration),
                          chosen(request.jerk, most_.jerk)};
  if (to_velocity) {
    motion_.move_with(request.velocity < 0 ? -wanted.velocity : wanted.velocity, wanted);
    state_ = AxisState::ContinuousMotion;
    return ErrorCode::Ok;
  }
  const bool relative = service == AxisService::MoveRelative;
  if (!relative && !homed_) {
    return ErrorCode::NotHomed;
  }
  const double target = request.position * scale_.unit + (relative ? motion_.state().position : 0);
  if (!endless_ && !(target >= lower_ - 1e-9 && target <= upper_ + 1e-9)) {
    return ErrorCode::JointLimit;
  }
  motion_.move_to(target, wanted);
  state_ = AxisState::DiscreteMotion;
  return ErrorCode::Ok;
}

void AxisControl::wait_for_power(double seconds) noexcept {
  waited_ += seconds;
  if (drive_.enabled()) {
    finish(ErrorCode::Ok);
  } else if (waited_ > kPowerTime) {
    want_power_ = false;
    finish(drive_.faulty() ? ErrorCode::Drive : ErrorCode::Power);
  }
}

// PLCopen: an axis that is still braking is not reset.
void AxisControl::wait_for_reset(double seconds) noexcept {
  if (!motion_.at_rest()) {
    return;
  }
  if (state_ == AxisState::ErrorStop || drive_.faulty()) {
    reset();
  }
  waited_ += seconds;
  if (!drive_.faulty() || waited_ > kPowerTime) {
    finish(drive_.faulty() ? ErrorCode::Drive : ErrorCode::Ok);
  }
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
  state_ = failed ? AxisState::ErrorStop : AxisState::Standstill;
  finish(failed ? ErrorCode::NotHomed : ErrorCode::Ok);
}

// A motion without target must not run into the end of the axis.
void AxisControl::guard_limits(double seconds) noexcept {
  const LineState& now = motion_.state();
  const double rest = now.position + ramp(now, 0, limits(1)).distance;
  // It will be looked at again one period later.
  const double margin = radians(0.1) + seconds * (std::abs(now.velocity) + seconds * most_.acceleration);
  const bool ends =
      !endless_ && ((now.velocity > 0 && rest > upper_ - margin) || (now.velocity < 0 && rest < lower_ + margin));
  if (ends) {
    finish(ErrorCode::JointLimit);
    motion_.stop(limits(1));
    state_ = AxisState::Stopping;
  }
}

void AxisControl::move(double seconds) noexcept {
  if (active_ && service_ == AxisService::PowerOn) {
    wait_for_power(seconds);
  }
  if (state_ == AxisState::Homing) {
    move_home(seconds);
    return;
  }
  motion_.step(seconds);
  if (active_ && service_ == AxisService::PowerOff && motion_.at_rest()) {
    want_power_ = false;
    finish(ErrorCode::Ok);
  }
  if (active_ && service_ == AxisService::Reset) {
    wait_for_reset(seconds);
  }
  report_.in_velocity = state_ == AxisState::ContinuousMotion && motion_.done();
  if (state_ == AxisState::ContinuousMotion) {
    if (report_.in_velocity && active_) {
      finish(ErrorCode::Ok);
    }
    guard_limits(seconds);
  } else if ((state_ == AxisState::DiscreteMotion || state_ == AxisState::Stopping) && motion_.at_rest()) {
    state_ = AxisState::Standstill;
    if (active_) {
      finish(ErrorCode::Ok);
    }
  }
}

void AxisControl::follow(const LineState& state) noexcept {
  motion_.reset(state);
  state_ = AxisState::SynchronizedMotion;
}

void AxisControl::fail(ErrorCode code, double hardness) noexcept {
  finish(code);
  drive_.home(false);
  if (!motion_.at_rest()) {
    motion_.stop(limits(hardness));
  }
  state_ = AxisState::ErrorStop;
}

void AxisControl::reset() noexcept {
  drive_.reset();
  want_power_ = want_power_ && drive_.enabled();  // power comes back on request only
  if (state_ == AxisState::ErrorStop) {
    report_.error = ErrorCode::Ok;
  }
  if (state_ == AxisState::ErrorStop || state_ == AxisState::SynchronizedMotion) {
    state_ = drive_.enabled() ? AxisState::Standstill : AxisState::Disabled;
  }
}

DriveOut AxisControl::command(const DriveIn& in, bool quick_stop) noexcept {
  drive_.step(in, quick_stop ? Drive::Want::QuickStop : want_power_ ? Drive::Want::On : Drive::Want::Off);
  DriveOut out;
  out.control = drive_.control();
  out.mode = drive_.mode();
  out.position = counts(motion_.state().position * scale_.counts * scale_.gear);
  return out;
}

AxisReport AxisControl::report() const noexcept {
  AxisReport report = report_;
  report.state = state_;
  report.power = drive_.enabled() && !(active_ && service_ == AxisService::PowerOn);
  report.homed = homed_;
  report.position = measured_ / scale_.unit;
  report.velocity = motion_.state().velocity / scale_.unit;
  return report;
}

}  // namespace indurop::robot
