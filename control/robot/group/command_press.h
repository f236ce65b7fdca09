// SPDX-License-Identifier: Apache-2.0
// A program lets the tool press (RobotPress): its command has the limits, and each update of it has the forces that are
// wanted and measured. Apart from where these come from, it is PRESS of jobs.

#pragma once

#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/job_motions.h"
#include "control/robot/group/motion_queue.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class CommandPress {
 public:
  CommandPress(Robot& robot, GroupPort& group, JobMotions& motions, const MotionQueue& queue,
               const ConveyorTracking& conveyor) noexcept
      : robot_(robot), group_(group), motions_(motions), queue_(queue), conveyor_(conveyor) {}

  // Takes a command, or rejects it: Value, State. Real-time safe, like all functions of this class.
  void take(int ticket) noexcept;
  // The command Halt has been taken: this ends when path and tool rest.
  void end_at_rest() noexcept { halted_ = true; }
  // Called once per period, before and after commands are taken: reports whether others are possible; presses.
  void sense() noexcept;
  void step() noexcept;

 private:
  // Returns whether the tool presses, begins to, or comes to rest after it.
  [[nodiscard]] bool on() const noexcept { return ticket_ != CommandTable::kNone; }
  [[nodiscard]] ErrorCode check(const Command& command) const noexcept;
  // Returns whether the tool presses, and neither begins nor ends.
  [[nodiscard]] bool goes_on() const noexcept { return begun_ && !halted_ && robot_.table.execute(ticket_); }
  void begin() noexcept;
  [[nodiscard]] bool is_silent(const Command& command) noexcept;
  void press(const Command& command) noexcept;
  void end(ErrorCode code) noexcept;
  void fail(const char* why) noexcept;

  Robot& robot_;
  GroupPort& group_;
  JobMotions& motions_;
  const MotionQueue& queue_;
  const ConveyorTracking& conveyor_;
  int ticket_ = CommandTable::kNone;
  bool begun_ = false;
  bool halted_ = false;
  CorrectionWay way_;
  std::array<double, 3> stiffness_{};  // N/m along each axis
  double most_ = 0;                    // N of all axes together
  double patience_ = 0;                // s after which another measurement has to have been counted; 0: any time
  double count_ = 0;                   // of the measurements
  double silent_ = 0;                  // s since the last update
  double age_ = 0;                     // s since the last measurement
};

}  // namespace indurop::robot
