// SPDX-License-Identifier: Apache-2.0
// Hands the commands of the table to the classes that execute them. A command that is no motion ends on its own, and a
// later one replaces the one before.

#pragma once

#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/motion_queue.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/service_desk.h"
#include "control/robot/group/stops.h"

namespace indurop::robot {

class CommandDesk {
 public:
  CommandDesk(Robot& robot, ServiceDesk& services, MotionQueue& queue, ConveyorTracking& conveyor,
              Stops& stops) noexcept
      : robot_(robot), services_(services), queue_(queue), conveyor_(conveyor), stops_(stops) {}

  // Takes all new commands. Real-time safe.
  void serve(const Inputs& in, const ModeGuard& mode) noexcept;

 private:
  void take(int ticket, const CamTables& cams) noexcept;

  Robot& robot_;
  ServiceDesk& services_;
  MotionQueue& queue_;
  ConveyorTracking& conveyor_;
  Stops& stops_;
};

}  // namespace indurop::robot
