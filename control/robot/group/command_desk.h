// SPDX-License-Identifier: Apache-2.0
// Hands the commands of the table to the classes that execute them. A command that is no motion ends on its own, and a
// later one replaces the one before.

#pragma once

#include "control/robot/group/command_press.h"
#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/master_sync.h"
#include "control/robot/group/motion_queue.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/service_desk.h"
#include "control/robot/group/stops.h"

namespace indurop::robot {

class CommandDesk {
 public:
  // The classes that execute commands which are neither motions nor services.
  struct Others {
    ConveyorTracking& conveyor;
    MasterSync& sync;
    Stops& stops;
    JobMotions& motions;
  };
  CommandDesk(Robot& robot, GroupPort& group, ServiceDesk& services, MotionQueue& queue, const Others& others) noexcept
      : robot_(robot),
        services_(services),
        queue_(queue),
        others_(others),
        press_(robot, group, others.motions, queue, others.conveyor) {}

  // Takes all new commands. Real-time safe.
  void serve(const Inputs& in, const ModeGuard& mode) noexcept;

 private:
  void take(int ticket, const CamTables& cams) noexcept;

  Robot& robot_;
  ServiceDesk& services_;
  MotionQueue& queue_;
  Others others_;
  CommandPress press_;
};

}  // namespace indurop::robot
