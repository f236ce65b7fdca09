// SPDX-License-Identifier: Apache-2.0
// Power and reset of an axis. A command may hold the power as long as it has its Execute (MC_Power): it requests power
// again whenever it is lost, and waits while the axis is in ErrorStop.

#pragma once

#include <indurop/robot/commands.h>

#include "control/robot/axis/answers.h"
#include "control/robot/axis/body.h"

namespace indurop::robot {

class AxisPower {
 public:
  AxisPower(AxisParts& parts, AxisAnswers& answers) noexcept : parts_(parts), answers_(answers) {}

  // Takes a command. Returns true if the axis has to stop, because power is to be switched off. Real-time safe, like
  // all functions of this class.
  [[nodiscard]] bool take(int ticket, const Command& command) noexcept;
  // Called once per period before the motion: keeps the power of a command that holds it, and waits for the drive.
  // Returns true if the axis has to stop.
  [[nodiscard]] bool keep() noexcept;
  void wait_for_power(double seconds) noexcept;
  // Called once per period after the motion.
  void step(double seconds) noexcept;
  void fail(ErrorCode code) noexcept;
  // Leaves ErrorStop; a fault of the drive is acknowledged.
  void reset() noexcept;
  // Ends what the last request waits for.
  void end_request() noexcept;

  void want(bool on) noexcept { wanted_ = on; }
  [[nodiscard]] bool wanted() const noexcept { return wanted_; }
  // The group switches power off: an axis that moves as a single axis or whose power is held keeps it.
  void give_up() noexcept { wanted_ = wanted_ && (answers_.holds_power() || parts_.busy()); }
  // Returns whether the command that held power has lost its Execute.
  [[nodiscard]] bool falls() const noexcept { return answers_.has_holder() && !answers_.holds_power(); }
  // In an emergency no axis is reset; while the group stops because of an error, a reset waits.
  void set_stops(bool emergency, bool group_stops) noexcept {
    emergency_ = emergency;
    group_stops_ = group_stops;
  }
  // Returns what the drive is to do; `quick_stop`: it is about to lose power, whatever its status.
  [[nodiscard]] Drive::Want want_of_drive(bool quick_stop) noexcept;
  [[nodiscard]] bool on() const noexcept { return parts_.drive.enabled() && owner_.service != AxisService::PowerOn; }

 private:
  void interrupt() noexcept;
  void switch_on(int ticket) noexcept;
  void take_reset(int ticket, bool failed) noexcept;
  void wait_for_reset(double seconds) noexcept;

  AxisParts& parts_;
  AxisAnswers& answers_;
  AxisOwner owner_;
  bool wanted_ = false;
  bool switching_off_ = false;  // waits for the drive, still on from before PowerOn, to switch off
  double waited_ = 0;           // s
  bool emergency_ = false;
  bool group_stops_ = false;
  bool quick_stopped_ = false;
};

}  // namespace indurop::robot
