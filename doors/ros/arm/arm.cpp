// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/arm.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace indurop::ros {

Arm::Arm(Variable state, Variable axes, Variable arm, Variable speed, Variable hold)
    : state_(std::move(state)),
      axis_states_(std::move(axes)),
      arm_(std::move(arm)),
      override_(std::move(speed)),
      hold_(std::move(hold)) {}

Result<Arm, base::Problem> Arm::find(const Node& node, const std::string& group) {
  auto state = Variable::find(node, group + "::ROBOT_MODULE_STATE");
  auto axes = Variable::find(node, group + "::AXIS_STATE");
  auto arm = Variable::find(node, group + "::ROBOT_ARM");
  auto speed = Variable::find(node, group + "::ROBOT_OVERRIDE");
  auto hold = Variable::find(node, group + "::ROBOT_HOLD");
  for (const auto* const found : {&state, &axes, &arm, &speed, &hold}) {
    if (!*found) {
      return base::Problem{
          fmt::format("node {} has no robot with variables in {}: {}", node.name(), group, found->error().text)};
    }
  }
  Arm all(std::move(*state), std::move(*axes), std::move(*arm), std::move(*speed), std::move(*hold));
  for (const char* const part : {"[0].dMaxJerk", "[0].dOwnJerk", "[0].bLowerCounts", "[0].dActualVelocity"}) {
    if (!all.axis_states_.has(part)) {
      return base::Problem{fmt::format("{}::AXIS_STATE has no {}; use the plc_robot.glb of this release", group, part)};
    }
  }
  if (!all.read()) {
    return base::Problem{irp_error()};
  }
  return all;
}

bool Arm::read() {
  if (!state_.read() || !axis_states_.read() || !arm_.read() || !override_.read() || !hold_.read()) {
    return false;
  }
  const auto axes = static_cast<std::size_t>(state_.number("nAXESGROUP"));
  axes_.resize(std::min(axes, axis_states_.layout().count()));
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    read_axis(i);
  }
  return true;
}

void Arm::read_axis(std::size_t number) {
  AxisNow& axis = axes_[number];
  const auto value = [this, number](const char* field) {
    return axis_states_.number(fmt::format("[{}].{}", number, field));
  };
  axis.state = static_cast<robot::AxisState>(value("eState"));
  axis.position = value("dPosition");
  axis.velocity = value("dActualVelocity");
  axis.command = value("dCommand");
  axis.torque = value("dTorque");
  axis.lower = value("bLowerCounts") != 0 ? std::max(value("dOwnLower"), value("dLower")) : value("dLower");
  axis.upper = value("bUpperCounts") != 0 ? std::min(value("dOwnUpper"), value("dUpper")) : value("dUpper");
  axis.most_velocity = value("dOwnVelocity");
  axis.most_acceleration = std::min(value("dOwnAcceleration"), value("dOwnDeceleration"));
  axis.most_jerk = value("dOwnJerk");
}

bool Arm::stands() const noexcept {
  return std::all_of(axes_.begin(), axes_.end(),
                     [](const AxisNow& axis) { return axis.state == robot::AxisState::Standstill; });
}

std::string Arm::obstacle(Locked locked) const {
  if (axes_.empty()) {
    return "the robot task has not started yet";
  }
  switch (static_cast<robot::GroupState>(state_.number("eState"))) {
    case robot::GroupState::Disabled:
      return "the drives have no power; request SVC_AD_GROUP_ENABLE";
    case robot::GroupState::Moving:
      return "the robot executes a motion or a job";
    case robot::GroupState::Homing:
    case robot::GroupState::Stopping:
      return "the robot is homing or stopping";
    case robot::GroupState::ErrorStop:
      return "the robot is in ERRORSTOP; remove the cause, then request SVC_AD_GROUP_RESET";
    case robot::GroupState::Standby:
      break;
  }
  if (hold_.number("") != 0) {
    return "the robot is held (ROBOT_HOLD)";
  }
  constexpr double kFull = 100;
  if (locked == Locked::ToTime && !(override_.number("") >= kFull)) {
    return "the override is below 100 %, and a trajectory is locked to time; set ROBOT_OVERRIDE to 100";
  }
  if (arm_.number("bMayMove") == 0) {
    return "mode switch or enabling switch do not allow motions";
  }
  return {};
}

}  // namespace indurop::ros
