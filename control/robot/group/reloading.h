// SPDX-License-Identifier: Apache-2.0
// Reloads jobs, points, tools, frames and zones from their files while the robot is at standstill: the service
// JobReload.

#pragma once

#include "control/robot/files/program_loader.h"
#include "control/robot/group/collisions_ahead.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/torque_watch.h"

namespace indurop::robot {

class Reloading {
 public:
  Reloading(Robot& robot, GroupPort& group, Plans& plans, CollisionsAhead& clear, TorqueWatch& torques)
      : robot_(robot),
        group_(group),
        plans_(plans),
        clear_(clear),
        torques_(torques),
        loader_(robot.parts.settings, robot.parts.urdf) {}

  // Called once per period. `wanted`: the service is being served; `resting`: no motion of commands waits, and power is
  // not being switched on. The result is used only if the service still waits for it, and nothing moves. Real-time
  // safe.
  void step(bool wanted, bool resting, Signals& signals) noexcept;

  // Returns whether jobs were ever reloaded: then not all is as it was loaded first.
  [[nodiscard]] bool used() const noexcept { return used_; }

 private:
  [[nodiscard]] bool possible(bool resting) const noexcept;
  void take_result(bool wanted, bool possible, Signals& signals) noexcept;
  ErrorCode take_program(Program& program, Signals& signals) noexcept;

  Robot& robot_;
  GroupPort& group_;
  Plans& plans_;
  CollisionsAhead& clear_;
  TorqueWatch& torques_;
  ProgramLoader loader_;
  bool reading_ = false;
  bool used_ = false;
};

}  // namespace indurop::robot
