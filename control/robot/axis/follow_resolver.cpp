// SPDX-License-Identifier: Apache-2.0
// Resolves how a single axis follows others: which may be a master, and where following leads.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "control/robot/axis/control.h"
#include "control/robot/axis/resolver.h"
#include "control/robot/axis/service.h"

namespace indurop::robot {

namespace {

constexpr double kMostRatio = 1e6;
constexpr double kLeastWay = 1e-6;  // rad or m of the master, minimum distance to engage over

}  // namespace

// Returns whether the axis would follow itself, directly or through other axes.
bool CommandResolver::follows_itself(const AxisFollow& way) const noexcept {
  std::array<bool, kAxes> ahead{};
  for (std::size_t i = 0; i < way.leading; ++i) {
    ahead[at(way.leaders[i].axis)] = true;
  }
  for (std::size_t rounds = 0; rounds < parts_.row.axes.size(); ++rounds) {
    for (std::size_t i = 0; i < parts_.row.axes.size(); ++i) {
      for (const AxisLeader& leader : parts_.row.axes[i].leaders()) {
        ahead[at(leader.axis)] = ahead[at(leader.axis)] || ahead[i];
      }
    }
  }
  return ahead[at(parts_.row.own)];
}

ErrorCode CommandResolver::follow(const Command& command, const AxisOrder& order, AxisFollow& way) const noexcept {
  const AxisService service = axis_service_of(command);
  if (service == AxisService::FollowPath) {
    return of_tool(command, way);
  }
  const int first = parts_.row.first + 1;
  way.leading = service == AxisService::Combine ? 2 : 1;
  way.leaders = {AxisLeader{command.option - first}, AxisLeader{command.job - first}};
  for (std::size_t i = 0; i < way.leading; ++i) {
    if (way.leaders[i].axis < 0 || at(way.leaders[i].axis) >= parts_.row.axes.size()) {
      return ErrorCode::Value;
    }
  }
  if (follows_itself(way)) {
    return ErrorCode::Value;
  }
  for (std::size_t i = 0; i < way.leading; ++i) {
    if (!parts_.row.axis(way.leaders[i].axis).leads()) {
      return ErrorCode::Master;
    }
  }
  switch (service) {
    case AxisService::CamIn:
      return cam(command, parts_.row.axis(way.leaders[0].axis), way.law);
    case AxisService::GearInPos:
      return meeting(command, order, way);
    default:
      return ratios(command, way);
  }
}

// The axis moves by a part of the tool's way. What it missed before it is in step is not made up for.
ErrorCode CommandResolver::of_tool(const Command& command, AxisFollow& way) const noexcept {
  constexpr double kMillimetre = 0.001;
  constexpr double kRounding = 5e-11;  // m
  const double ratio = command.to[0] / command.to[1];
  if (parts_.row.travel == nullptr || !(std::abs(ratio) <= kMostRatio)) {
    return ErrorCode::Value;
  }
  way.leading = 0;
  way.law.ratio = ratio * parts_.units.unit() / kMillimetre;
  way.law.master_rounding = kRounding;
  return parts_.row.travel->leads ? ErrorCode::Ok : ErrorCode::Master;
}

// With one master, the law has the ratio. With two, the axis follows the sum of their scaled motions.
ErrorCode CommandResolver::ratios(const Command& command, AxisFollow& way) const noexcept {
  for (std::size_t i = 0; i < way.leading; ++i) {
    const double ratio = command.to[2 * i] / command.to[2 * i + 1];
    if (!(std::abs(ratio) <= kMostRatio)) {
      return ErrorCode::Value;
    }
    AxisLeader& leader = way.leaders[i];
    leader.ratio = ratio * parts_.units.unit() / parts_.row.axis(leader.axis).unit();
  }
  if (way.leading == 1) {
    way.law.ratio = std::exchange(way.leaders[0].ratio, 1);
  }
  return ErrorCode::Ok;
}

// Engages the gear at given positions of both axes.
ErrorCode CommandResolver::meeting(const Command& command, const AxisOrder& order, AxisFollow& way) const noexcept {
  const AxisControl& master = parts_.row.axis(way.leaders[0].axis);
  const auto finite = [](double x) { return std::abs(x) <= kMostRatio; };
  if (!std::all_of(command.to.begin(), command.to.begin() + 5, finite) || command.to[4] < 0) {
    return ErrorCode::Value;
  }
  if (const ErrorCode code = ratios(command, way); code != ErrorCode::Ok) {
    return code;
  }
  if (!parts_.homed || !master.homed()) {
    return ErrorCode::NotHomed;
  }
  CouplingLaw& law = way.law;
  law.master_zero = master.units().origin() + command.to[2] * master.unit();
  law.slave_zero = parts_.units.origin() + command.to[3] * parts_.units.unit();
  const double ahead = law.master_zero - master.commanded().position;
  const double asked = command.to[4] * master.unit();
  const double length = asked > 0 ? std::min(asked, std::abs(ahead)) : std::abs(ahead);
  if (length < kLeastWay) {
    return ErrorCode::Speed;  // the master is already there
  }
  const LineState& now = parts_.motion.state();
  const LineLimits braking{order.limits.velocity, std::min(order.limits.acceleration, order.braking.acceleration),
                           order.limits.jerk};
  const double start = now.position + ramp(now, 0, braking).distance;
  law.approach = {law.master_zero - std::copysign(length, ahead), law.master_zero, start, law.slave_zero, law.ratio};
  const auto [least, greatest] = law.approach.extent();
  return parts_.bounds.inside(least, greatest) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

// Its zeros are those of the axes, or the present positions of both.
ErrorCode CommandResolver::cam(const Command& command, const AxisControl& master, CouplingLaw& law) const noexcept {
  const int number = command.job - 1;
  const double master_scale = command.to[2];
  const double slave_scale = command.to[3];
  const auto finite = [](double x) { return std::abs(x) <= kMostRatio; };
  if (number < 0 || at(number) >= parts_.row.cams.size() || !parts_.row.cams[at(number)].known() ||
      !std::all_of(command.to.begin(), command.to.begin() + 4, finite) || std::abs(master_scale) < 1 / kMostRatio) {
    return ErrorCode::Value;
  }
  const bool absolute_master = command.aux[0] != 0;
  const bool absolute_slave = command.aux[1] != 0;
  if ((absolute_master && !master.homed()) || (absolute_slave && !parts_.homed)) {
    return ErrorCode::NotHomed;
  }
  const double there = master.commanded().position;
  law.cam = parts_.row.cams[at(number)];
  law.master_scale = master_scale * master.unit();
  law.slave_scale = slave_scale * parts_.units.unit();
  law.master_zero = (absolute_master ? master.units().origin() : there) + command.to[0] * master.unit();
  law.slave_zero = 0;
  law.slave_zero = command.to[1] * parts_.units.unit() +
                   (absolute_slave ? parts_.units.origin() : parts_.motion.state().position - law.at(there));
  const auto [least, greatest] = law.cam.extent();
  const double one = law.slave_zero + least * law.slave_scale;
  const double other = law.slave_zero + greatest * law.slave_scale;
  return parts_.bounds.inside(one, other) ? ErrorCode::Ok : ErrorCode::JointLimit;
}

}  // namespace indurop::robot
