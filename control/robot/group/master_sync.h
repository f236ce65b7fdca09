// SPDX-License-Identifier: Apache-2.0
// The path of the group follows a master, a single axis or a belt (MC_SyncGroupToAxis): it has gone as far as the
// master says, as nearly as the limits of the planned path permit. It acts like an override that changes in each
// period, so it makes no motion faster than planned, and none leaves its path.

#pragma once

#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class MasterSync {
 public:
  MasterSync(Robot& robot, GroupPort& group, const ConveyorTracking& conveyor) noexcept
      : robot_(robot), group_(group), conveyor_(conveyor) {}

  // Takes a command, or rejects it: Value, State, Master, Belt. Real-time safe, like all functions of this class.
  void take(int ticket) noexcept;
  // The command Halt has been taken: this ends when the group has come to rest.
  void end_at_rest() noexcept { ends_ = true; }
  // Returns whether the path follows a master, also while the tool rests.
  [[nodiscard]] bool on() const noexcept { return ticket_ != CommandTable::kNone; }
  // Called once per period, before the path is followed. `held`: the path stands still for another reason, so what the
  // master moves meanwhile does not count. Returns the part of full speed, from 0 to 1; 1: the path follows nothing.
  double step(bool held) noexcept;

 private:
  // In the master's mm or degrees.
  struct Master {
    double place = 0, speed = 0;
    ErrorCode code = ErrorCode::Ok;
  };
  [[nodiscard]] ErrorCode check(const Command& command) const noexcept;
  [[nodiscard]] Master master() const noexcept;
  [[nodiscard]] double part_for(double lag, double speed) const noexcept;
  void end(ErrorCode code) noexcept;
  void fail(ErrorCode code, const char* why) noexcept;

  Robot& robot_;
  GroupPort& group_;
  const ConveyorTracking& conveyor_;
  int ticket_ = CommandTable::kNone;
  bool ends_ = false;
  int axis_ = -1;      // of the single axes, from 0; -1: the belt
  int belt_ = 0;       // from 0
  double ratio_ = 0;   // m of the path for each mm or degree of the master
  double most_ = 0;    // m behind or ahead
  double seen_ = 0;    // place of the master in the last period
  double wanted_ = 0;  // place of the path that the master asks for, as Travel counts
  double part_ = 1;    // of full speed
};

}  // namespace indurop::robot
