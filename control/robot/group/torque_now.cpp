// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/torque_now.h"

#include <cmath>

namespace indurop::robot {

Fault too_heavy(const Robot& robot, const Joints& q) noexcept {
  const Dynamics& dynamics = robot.tool.dynamics();
  if (!dynamics.limited()) {
    return {};
  }
  const Joints velocity = (q - robot.axes.last()) / robot.period;
  const Joints acceleration = (velocity - robot.axes.last_speed()) / robot.period;
  const Joints needed = dynamics.torques(q, velocity, acceleration) + dynamics.friction(velocity);
  for (int i = 0; i < robot.count(); ++i) {
    const double most = dynamics.effort()[i];
    if (most > 0 && std::abs(needed[i]) > most) {
      return {ErrorCode::Torque, i + 1};
    }
  }
  return {};
}

}  // namespace indurop::robot
