// SPDX-License-Identifier: Apache-2.0
// Power of the drives for the group, and the reset after an error: the services GroupEnable and GroupReset.

#pragma once

#include "control/robot/group/group_port.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/torque_watch.h"

namespace indurop::robot {

class Power {
 public:
  Power(Robot& robot, GroupPort& group, TorqueWatch& torques) noexcept
      : robot_(robot), group_(group), torques_(torques) {}

  // Begin a service. Real-time safe, like all functions of this class.
  ErrorCode enable() noexcept;
  ErrorCode begin_reset() noexcept;
  // Continue it in each period: in Disabled, and while a reset is being served.
  void run_enabling() noexcept;
  // Called until the robot is at standstill and the drives have left their faults. Drives have faults without power,
  // too.
  ErrorCode reset() noexcept;
  [[nodiscard]] bool enabling() const noexcept { return enabling_; }
  void cancel() noexcept { enabling_ = false; }

  // Returns whether the drives are stopped with their own quick stop: after an emergency and after a crash.
  [[nodiscard]] bool quick_stop() const noexcept { return quick_stop_; }
  void set_quick_stop(bool on) noexcept { quick_stop_ = on; }

 private:
  [[nodiscard]] bool any_switches_off() const noexcept;
  void fail_enabling() noexcept;
  bool clear_faults() noexcept;

  Robot& robot_;
  GroupPort& group_;
  TorqueWatch& torques_;
  bool enabling_ = false;
  bool switching_off_ = false;  // drives still on from before must switch off first
  bool quick_stop_ = false;
  double waited_ = 0;  // s
};

}  // namespace indurop::robot
