// SPDX-License-Identifier: Apache-2.0
// What the services of the group do, depending on its state. ServiceDesk keeps which one is being executed.

#pragma once

#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/guiding.h"
#include "control/robot/group/job_motions.h"
#include "control/robot/group/mode_guard.h"
#include "control/robot/group/motion_queue.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/power.h"
#include "control/robot/group/resuming.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/stops.h"

namespace indurop::robot {

class Services {
 public:
  // The classes that execute services, or whose state permits them.
  struct Parts {
    Plans& plans;
    Resuming& resuming;
    const ConveyorTracking& conveyor;
    const Guiding& guiding;
    const MotionQueue& queue;
    const ModeGuard& mode;
    Stops& stops;
    Power& power;
    JobMotions& job;
  };
  Services(Robot& robot, GroupPort& group, const Parts& parts) noexcept : robot_(robot), group_(group), parts_(parts) {}

  // Begins a service. A service that has ended already has called GroupPort::finish_service(). An error ends it too.
  // Real-time safe, like all functions of this class.
  ErrorCode begin(Service service, const ServiceRequest& request) noexcept;
  // Checks whether a service may move the robot, which it may not while a job does.
  [[nodiscard]] ErrorCode may_move() const noexcept;
  // Returns whether a job was stopped and nothing else prevents its continuation.
  [[nodiscard]] bool comes_to_rest() const noexcept;

 private:
  ErrorCode home() noexcept;
  ErrorCode move(Service service, const ServiceRequest& request) noexcept;
  ErrorCode make_move(Service service, const ServiceRequest& request, MoveCommand& command) const noexcept;
  ErrorCode redirect(const ServiceRequest& request) noexcept;
  ErrorCode start_job(std::uint32_t number, std::uint32_t line) noexcept;
  ErrorCode select_tool(std::uint32_t tool) noexcept;
  [[nodiscard]] ErrorCode may_begin() const noexcept;

  Robot& robot_;
  GroupPort& group_;
  Parts parts_;
};

}  // namespace indurop::robot
