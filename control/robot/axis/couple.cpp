// SPDX-License-Identifier: Apache-2.0
// Single axes that follow another one: which axis may be a master, how following begins, and how it ends, by request or
// by an error.

#include <algorithm>
#include <cmath>
#include <utility>

#include "control/robot/axis/control.h"

namespace indurop::robot {

namespace {

constexpr double kMostRatio = 1e6;
constexpr double kLeastWay = 1e-6;  // rad or m of the master, minimum distance to engage over

}  // namespace

bool AxisControl::leads() const noexcept {
  return !placed_anew_ && !push_.pushes() && state_ != AxisState::Disabled && state_ != AxisState::ErrorStop &&
         state_ != AxisState::Homing;
}

// Returns whether the axis would follow itself, directly or through other axes.
bool AxisControl::follows_itself(const Coupled& way) const noexcept {
  std::array<bool, kAxes> ahead{};
  for (std::size_t i = 0; i < way.leading; ++i) {
    ahead[at(way.leaders[i].axis)] = true;
  }
  for (std::size_t rounds = 0; rounds < row_.axes.size(); ++rounds) {
    for (std::size_t i = 0; i < row_.axes.size(); ++i) {
      for (const Leader& leader : row_.axes[i].leaders()) {
        ahead[at(leader.axis)] = ahead[at(leader.axis)] || ahead[i];
      }
    }
  }
  return ahead[at(row_.own)];
}

ErrorCode AxisControl::resolve(const Command& command, const Order& order, Coupled& way) const noexcept {
  const AxisService service = service_of(command);
  way.leading = service == AxisService::Combine ? 2 : 1;
  way.leaders = {Leader{command.option - 1}, Leader{command.job - 1}};
  for (std::size_t i = 0; i < way.leading; ++i) {
    if (way.leaders[i].axis < 0 || at(way.leaders[i].axis) >= row_.axes.size()) {
      return ErrorCode::Value;
    }
  }
  if (follows_itself(way)) {
    return ErrorCode::Value;
  }
  for (std::size_t i = 0; i < way.leading; ++i) {
    if (!row_.axes[at(way.leaders[i].axis)].leads()) {
      return ErrorCode::Master;
    }
  }
  switch (service) {
    case AxisService::CamIn:
      return resolve_cam(command, row_.axes[at(way.leaders[0].axis)], way.law);
    case AxisService::GearInPos:
      return resolve_meeting(command, order, way);
    default:
      return resolve_ratios(command, way);
  }
}

// With one master, the law has the ratio. With two, the axis follows the sum of their scaled motions.
ErrorCode AxisControl::resolve_ratios(const Command& command, Coupled& way) const noexcept {
  for (std::size_t i = 0; i < way.leading; ++i) {
    const double ratio = command.to[2 * i] / command.to[2 * i + 1];
    if (!(std::abs(ratio) <= kMostRatio)) {
      return ErrorCode::Value;
    }
    Leader& leader = way.leaders[i];
    leader.ratio = ratio * scale_.unit / row_.axes[at(leader.axis)].scale_.unit;
  }
  if (way.leading == 1) {
    way.law.ratio = std::exchange(way.leaders[0].ratio, 1);
  }
  return ErrorCode::Ok;
}

// Engages the gear at given positions of both axes.
ErrorCode AxisControl::resolve_meeting(const Command& command, const Order& order, Coupled& way) const noexcept {
  const AxisControl& master = row_.axes[at(way.leaders[0].axis)];
  const auto finite = [](double x) { return std::abs(x) <= kMostRatio; };
  if (!std::all_of(command.to.begin(), command.to.begin() + 5, finite) || command.to[4] < 0) {
    return ErrorCode::Value;
  }
  if (const ErrorCode code = resolve_ratios(command, way); code != ErrorCode::Ok) {
    return code;
  }
  if (!homed_ || !master.homed_) {
    return ErrorCode::NotHomed;
  }
  CouplingLaw& law = way.law;
  law.master_zero = master.origin_ + command.to[2] * master.scale_.unit;
  law.slave_zero = origin_ + command.to[3] * scale_.unit;
  const double ahead = law.master_zero - master.commanded().position;
  const double asked = command.to[4] * master.scale_.unit;
  const double length = asked > 0 ? std::min(asked, std::abs(ahead)) : std::abs(ahead);
  if (length < kLeastWay) {
    return ErrorCode::Speed;  // the master is already there
  }
  const LineState& now = motion_.state();
  const LineLimits braking{order.limits.velocity, std::min(order.limits.acceleration, order.braking.acceleration),
                           order.limits.jerk};
  const double start = now.position + ramp(now, 0, braking).distance;
  law.approach = {law.master_zero - std::copysign(length, ahead), law.master_zero, start, law.slave_zero, law.ratio};
  const auto [least, greatest] = law.approach.extent();
  return inside(least, greatest) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

bool AxisControl::inside(double one, double other) const noexcept {
  return endless_ || (std::min(one, other) >= lower_ - 1e-9 && std::max(one, other) <= upper_ + 1e-9);
}

// Its zeros are those of the axes, or the present positions of both.
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
  return inside(one, other) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

void AxisControl::couple(const Command& command, const Order& order) noexcept {
  Coupled way;
  static_cast<void>(resolve(command, order, way));  // checked before
  LineLimits limits = order.limits;
  limits.acceleration = std::min(limits.acceleration, order.braking.acceleration);
  leaders_ = way.leaders;
  leading_ = way.leading;
  finish(super_, ErrorCode::Aborted);
  coupling_.engage(way.law, limits, most_, motion_.state());
  coupled_ = true;
  leaving_ = false;
  state_ = AxisState::SynchronizedMotion;
  motion_.stop(this->limits(1));
  motion_.lend(motion_.state());
}

// Continues with its present speed.
void AxisControl::decouple(int ticket, const Command& /*command*/) noexcept {
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
  leave_torque();
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
  leave_torque();
  coupled_ = over_ = leaving_ = false;
  motion_.reset(state);
}

void AxisControl::advance_coupled(double seconds) noexcept {
  AxisCoupling::Master master;
  bool all_lead = true;
  for (const Leader& leader : leaders()) {
    const LineState& before = row_.gates[at(leader.axis)].state();
    const AxisControl& axis = row_.axes[at(leader.axis)];
    master.before.position += leader.ratio * before.position;
    master.before.velocity += leader.ratio * before.velocity;
    master.before.acceleration += leader.ratio * before.acceleration;
    master.now += leader.ratio * axis.commanded().position;
    all_lead = all_lead && axis.leads();
  }
  const ErrorCode code = all_lead ? coupling_.step(master, row_.gates[at(row_.own)], seconds) : ErrorCode::Master;
  if (code != ErrorCode::Ok) {
    fail_coupling(code);
  } else {
    motion_.lend(coupling_.state());
  }
}

// Advances by one period, whichever motion sets the target.
void AxisControl::advance(double seconds) noexcept {
  if (!prepare_torque(seconds)) {
    advance_torque(seconds);
    return;
  }
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
  guard_table();
  if (state_ == AxisState::ContinuousMotion) {
    guard_limits(seconds);
  }
  motion_.step(seconds);
  // A motion that passes its end continues with the next one in the same period, several times if they are short.
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
