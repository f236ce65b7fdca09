// SPDX-License-Identifier: Apache-2.0
// Stops of the group: after an error, by a command or a service, and because the operating mode demands it. The robot
// stays on its path if that can still be followed, even if an axis has no power; otherwise its axes brake in step.

#pragma once

#include "control/robot/group/group_port.h"
#include "control/robot/group/last_gate.h"
#include "control/robot/group/off_path.h"
#include "control/robot/group/power.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class Stops {
 public:
  Stops(Robot& robot, GroupPort& group, LastGate& gate, const OffPath& off_path, Power& power) noexcept
      : robot_(robot), group_(group), gate_(gate), off_path_(off_path), power_(power) {}

  // Errors; see GroupPort. Real-time safe, like all functions of this class.
  void trip(ErrorCode code, int axis, double hardness, const char* why) noexcept;
  void fall_off(ErrorCode code, int axis) noexcept;
  void stop_for(const Fault& fault) noexcept;
  // The same for the fault of the job, which has failed.
  void stop_for_job() noexcept;
  // Comes to rest on the path; power stays on (stop category 2). The person who releases the enabling switch may be in
  // danger.
  void stop_for_mode(ErrorCode code) noexcept;

  // The command Stop: from any state with power, and it holds as long as its function block has its Execute input set.
  void take(int ticket) noexcept;
  [[nodiscard]] bool held_by_command() const noexcept { return ticket_ != CommandTable::kNone; }
  // Services: Stop and JobStop; GroupDisable.
  ErrorCode stop() noexcept;
  ErrorCode disable() noexcept;

  // Called in each period of state Stopping.
  void step() noexcept;

 private:
  void leave_path(ErrorCode code) noexcept;
  void stop_motion() noexcept;
  void halt_axes() noexcept;
  void rest() noexcept;
  void release() noexcept;

  Robot& robot_;
  GroupPort& group_;
  LastGate& gate_;
  const OffPath off_path_;
  Power& power_;
  int ticket_ = CommandTable::kNone;  // of the command
};

}  // namespace indurop::robot
