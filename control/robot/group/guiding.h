// SPDX-License-Identifier: Apache-2.0
// Guiding by hand: a person moves the arm, which gives way like a mass with damping. The drives keep following set
// points (ADR 59): those of the next period come from the torques that the drives measure beyond what the arm needs.
// Each of them is sent only if all axes could come to rest from there within the limits; otherwise they go on braking
// as was checked in the period before.

#pragma once

#include "control/robot/group/enabling_switch.h"
#include "control/robot/group/fault_text.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/guide_watch.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/torque_watch.h"

namespace indurop::robot {

class LastGate;
class ModeGuard;

class Guiding {
 public:
  Guiding(Robot& robot, GroupPort& group, TorqueWatch& torques) noexcept;

  // Reads the request of this period. Real-time safe, like all functions of this class.
  void step(const Inputs& in, const ModeGuard& mode) noexcept;
  // Returns whether the hand moves the arm, or may: set points are on no path.
  [[nodiscard]] bool on() const noexcept { return on_; }
  // Computes the next set points, while it is on. Enters Standby when the arm rests after the request has ended.
  void move(LastGate& gate) noexcept;
  // The motion has ended.
  void end() noexcept { on_ = false; }

 private:
  [[nodiscard]] Fault may_begin(const ModeGuard& mode) const noexcept;
  [[nodiscard]] Fault weigh() noexcept;
  void refuse(const Fault& fault, const char* why) noexcept;
  [[nodiscard]] Joints moving_part(const Joints& push) const noexcept;
  void feel() noexcept;
  [[nodiscard]] Joints shaped() noexcept;
  void brake_at_walls(Joints& velocity) const noexcept;
  void follow(int axis, double velocity) noexcept;

  Robot& robot_;
  GroupPort& group_;
  TorqueWatch& torques_;
  const Joints threshold_;  // torque that moves nothing
  EnablingSwitch enabling_switch_;
  GuideWatch watch_;
  bool on_ = false;
  bool wanted_ = false;
  bool blocked_ = false;              // refused, until the request ends
  double weighing_ = 0;               // s
  double part_ = 1;                   // of full speed, by override and hold
  double pace_ = 1;                   // part of full speed that is left near what the arm must not reach
  Joints velocity_ = Joints::Zero();  // of the mass that the hand feels
  FaultText text_ = "";
};

}  // namespace indurop::robot
