// SPDX-License-Identifier: Apache-2.0
// Motions of the group by commands: one after another, or replacing earlier ones at once. The first ones have been
// given to the planner; the motion that the follower executes determines which of them are done. Also the commands that
// interrupt them and continue.

#pragma once

#include <array>

#include "control/robot/group/command_motion.h"
#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class MotionQueue {
 public:
  MotionQueue(Robot& robot, GroupPort& group, Plans& plans, ConveyorTracking& conveyor) noexcept
      : robot_(robot), group_(group), plans_(plans), conveyor_(conveyor), motion_(robot, conveyor) {}

  // Takes a command, or rejects it. Real-time safe, like all functions of this class.
  void take(int ticket) noexcept;
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  // Called in each period of a motion: gives motions to the planner; reports those that have ended.
  void feed() noexcept;
  void note_progress() noexcept;
  // Ends a motion that is not possible, and those after it, whose start is no longer defined. `source`: its number for
  // the planner.
  void fail(int source, ErrorCode code) noexcept;
  // Ends all motions: the first one with this code, the others with Aborted.
  void drop(ErrorCode first) noexcept;

  // Commands: comes to rest on the path, whatever follows; continues.
  void interrupt(int ticket) noexcept;
  void go_on(int ticket) noexcept;
  [[nodiscard]] bool interrupted() const noexcept { return interrupted_; }
  // The interrupted motion has ended, or another one replaces it.
  void end_interrupt(ErrorCode code) noexcept;

 private:
  [[nodiscard]] const Command& command(int i) const noexcept { return robot_.table.command(motions_[at(i)]); }
  // Errors: Belt, State.
  [[nodiscard]] ErrorCode check_product(const Command& command) const noexcept;
  void begin_moving() noexcept;
  void replace_all(int ticket) noexcept;
  ErrorCode redirect(int ticket) noexcept;
  [[nodiscard]] double zone_of(int i) const noexcept;
  void halt(int ticket) noexcept;
  void end_first(int many, ErrorCode code) noexcept;
  void answer_interrupt(ErrorCode code) noexcept;

  Robot& robot_;
  GroupPort& group_;
  Plans& plans_;
  ConveyorTracking& conveyor_;
  CommandMotion motion_;
  std::array<int, CommandTable::kMaxCommands> motions_{};  // tickets
  int count_ = 0;
  int fed_ = 0;  // number of motions given to the planner
  Pose start_;   // where the next motion begins
  bool interrupted_ = false;
  int interrupt_ = CommandTable::kNone;  // ticket of the command
};

}  // namespace indurop::robot
