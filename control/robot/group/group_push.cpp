// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/group_push.h"

#include <algorithm>

namespace indurop::robot {

Fault GroupPush::begin(const PushWay& way) noexcept {
  robot_.axes.end_group_motion();
  Command command;
  command.code = static_cast<std::int32_t>(AxisService::TorqueControl);
  command.to[0] = way.torque;
  command.to[1] = way.ramp;
  command.velocity = way.speed;
  AxisControl& axis = robot_.axes[way.axis];
  axis.push(command);
  const ErrorCode code = axis.error();
  if (code == ErrorCode::Ok) {
    axis_ = way.axis;
    pace_ = std::min(1.0, way.speed * axis.unit() / robot_.parts.joints.velocity[way.axis]);
  }
  return {code, way.axis + 1};
}

void GroupPush::end() noexcept {
  if (on() && robot_.axes[axis_].state() == AxisState::ContinuousMotion) {
    robot_.axes[axis_].halt();
  }
}

PushState GroupPush::state() const noexcept {
  if (!on()) {
    return {false, {ErrorCode::Aborted}, pace_};
  }
  const AxisControl& axis = robot_.axes[axis_];
  if (axis.state() == AxisState::ContinuousMotion) {
    return {axis.pushes_fully(), {}, pace_};
  }
  return {false, {axis.error() == ErrorCode::Ok ? ErrorCode::Aborted : axis.error(), axis_ + 1}, pace_};
}

bool GroupPush::step() noexcept {
  if (on()) {
    robot_.follower.reset(robot_.commanded());
    axis_ = robot_.axes[axis_].busy() ? axis_ : -1;
  }
  return on();
}

}  // namespace indurop::robot
