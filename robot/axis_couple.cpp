// SPDX-License-Identifier: Apache-2.0
// Single axes that follow another one: which one may lead, how that begins, and how it ends whoever ends it.

#include <algorithm>
#include <cmath>

#include "robot/axis_control.h"

namespace indurop::robot {

namespace {

constexpr double kMostRatio = 1e6;

constexpr std::size_t at(int axis) noexcept {
  return static_cast<std::size_t>(axis);
}

}  // namespace

bool AxisControl::leads() const noexcept {
  return !placed_anew_ && state_ != AxisState::Disabled && state_ != AxisState::ErrorStop &&
         state_ != AxisState::Homing;
}

ErrorCode AxisControl::resolve(const Command& command, CouplingLaw& law) const noexcept {
  const int master = command.option - 1;
  if (master < 0 || at(master) >= row_.axes.size()) {
    return ErrorCode::Value;
  }
  // Nobody follows himself, not even by way of others.
  for (int next = master; next >= 0; next = row_.axes[at(next)].master()) {
    if (next == row_.own) {
      return ErrorCode::Value;
    }
  }
  const AxisControl& leading = row_.axes[at(master)];
  if (!leading.leads()) {
    return ErrorCode::Master;
  }
  if (static_cast<AxisService>(command.code) == AxisService::CamIn) {
    return resolve_cam(command, leading, law);
  }
  const double ratio = command.to[0] / command.to[1];
  law.ratio = ratio * scale_.unit / leading.scale_.unit;
  return std::abs(ratio) <= kMostRatio ? ErrorCode::Ok : ErrorCode::Value;
}

// Its zeros are those of the axes, or where both are now.
ErrorCode AxisControl::resolve_cam(const Command& command, const AxisControl& master, CouplingLaw& law) const noexcept {
  const int number = command.job - 1;
  const double master_scale = command.to[2];
  const double slave_scale = command.to[3];
  const auto finite = [](double x) { return std::abs(x) <= kMostRatio; };
  if (number < 0 || at(number) >= row_.cams.size() || !row_.cams[at(number)].known() ||
      !std::all_of(command.to.begin(), command.to.begin() + 4, finite) || std::abs(master_scale) < 1 / kMostRatio) {
    return ErrorCode::Value;
  }
  const bool absolute_master = command.aux[0] != 0;
  const bool absolute_slave = command.aux[1] != 0;
  if ((absolute_master && !master.homed_) || (absolute_slave && !homed_)) {
    return ErrorCode::NotHomed;
  }
  const double there = master.commanded().position;
  law.cam = row_.cams[at(number)];
  law.master_scale = master_scale * master.scale_.unit;
  law.slave_scale = slave_scale * scale_.unit;
  law.master_zero = (absolute_master ? master.origin_ : there) + command.to[0] * master.scale_.unit;
  law.slave_zero = 0;
  law.slave_zero = command.to[1] * scale_.unit + (absolute_slave ? origin_ : motion_.state().position - law.at(there));
  const auto [least, greatest] = law.cam.extent();
  const double one = law.slave_zero + least * law.slave_scale;
  const double other = law.slave_zero + greatest * law.slave_scale;
  const bool inside = endless_ || (std::min(one, other) >= lower_ - 1e-9 && std::max(one, other) <= upper_ + 1e-9);
  return inside ? ErrorCode::Ok : ErrorCode::JointLimit;
}

void AxisControl::couple(const Command& command, const Order& order) noexcept {
  CouplingLaw law;
  static_cast<void>(resolve(command, law));  // which has been looked at before
  LineLimits limits = order.limits;
  limits.acceleration = std::min(limits.acceleration, order.braking.acceleration);
  master_ = command.option - 1;
  finish(super_, ErrorCode::Aborted);
  coupling_.engage(law, limits, most_, motion_.state());
  coupled_ = true;
  leaving_ = false;
  state_ = AxisState::SynchronizedMotion;
  motion_.stop(this->limits(1));
  motion_.lend(motion_.state());
}

// Goes on with the speed that it has.
void AxisControl::decouple(int ticket) noexcept {
  Owner owner{ticket, AxisService::Decouple};
  if (!coupled_) {
    finish(owner, ErrorCode::State);
    return;
  }
  abort_queue();
  finish(motion_owner_, ErrorCode::Aborted);
  let_go();
  motion_.move_with(motion_.state().velocity, limits(1));
  state_ = AxisState::ContinuousMotion;
  finish(owner, ErrorCode::Ok);
}

void AxisControl::let_go() noexcept {
  finish(super_, ErrorCode::Aborted);
  if (over_) {
    motion_.lend(coupling_.state());
  }
  leaving_ = leaving_ || coupled_ || over_;
  coupled_ = over_ = false;
}

void AxisControl::fail_coupling(ErrorCode code) noexcept {
  abort_queue();
  finish(motion_owner_, code);
  let_go();
  motion_.stop(limits(1));
  state_ = AxisState::Stopping;
}

void AxisControl::put(const LineState& state) noexcept {
  coupled_ = over_ = leaving_ = false;
  motion_.reset(state);
}

void AxisControl::advance_coupled(double seconds) noexcept {
  const AxisControl& master = row_.axes[at(master_)];
  const AxisCoupling::Master leading{row_.gates[at(master_)].state(), master.commanded().position};
  const ErrorCode code =
      master.leads() ? coupling_.step(leading, row_.gates[at(row_.own)], seconds) : ErrorCode::Master;
  if (code != ErrorCode::Ok) {
    fail_coupling(code);
  } else {
    motion_.lend(coupling_.state());
  }
}

// One period on, whoever says where to.
void AxisControl::advance(double seconds) noexcept {
  if (coupled_) {
    advance_coupled(seconds);
  } else if (!leaving_) {
    advance_own(seconds);
  }
  if (!leaving_) {
    return;
  }
  leaving_ = !coupling_.leave(row_.gates[at(row_.own)], seconds);
  motion_.lend(coupling_.state());
  if (!leaving_) {
    motion_.go_on();
    advance_own(seconds);
  }
}

void AxisControl::advance_own(double seconds) noexcept {
  if (state_ == AxisState::ContinuousMotion) {
    guard_limits(seconds);
  }
  motion_.step(seconds);
  // What passes its end goes on with the next one, several times if they are short.
  for (int i = 0; motion_.passed() && i < CommandTable::kMost; ++i) {
    const double rest = motion_.rest_of_step();
    end_motion(ErrorCode::Ok);
    motion_.step(rest);
  }
  if (over_) {
    advance_over(seconds);
  }
}

}  // namespace indurop::robot
