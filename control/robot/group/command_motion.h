// SPDX-License-Identifier: Apache-2.0
// Converts a command of a motion of the group (PLCopen part 4) into a motion for the planner.

#pragma once

#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class CommandMotion {
 public:
  CommandMotion(const Robot& robot, const ConveyorTracking& conveyor) noexcept : robot_(robot), conveyor_(conveyor) {}

  // `start`: the tool's pose where the motion begins. Errors: JointLimit, Circle, Value. Real-time safe.
  ErrorCode make(const Command& command, const Pose& start, MoveCommand& move) const noexcept;

 private:
  [[nodiscard]] Pose machine_pose(const std::array<double, 8>& numbers, const Command& command,
                                  const Pose& start) const noexcept;
  ErrorCode make_target(const Command& command, const Pose& start, Target& target) const noexcept;
  ErrorCode make_circle(const Command& command, const Pose& from, MoveCommand& move) const noexcept;

  const Robot& robot_;
  const ConveyorTracking& conveyor_;
};

// The services of motions by command.
inline Service group_service_of(const Command& command) noexcept {
  return static_cast<Service>(command.code);
}
[[nodiscard]] bool is_motion(Service service) noexcept;
[[nodiscard]] bool is_direct(Service service) noexcept;
constexpr bool is_free(Service service) noexcept {
  return service == Service::FreeAbsolute;
}
// Returns whether all numbers of such a command are possible.
[[nodiscard]] bool is_sane(const Command& command) noexcept;

}  // namespace indurop::robot
