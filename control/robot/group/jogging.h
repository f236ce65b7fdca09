// SPDX-License-Identifier: Apache-2.0
// Jogging: a straight motion of one axis, or of the tip, as long as possible, which ends when it is no longer
// requested. So it keeps all limits like any other motion, and the tip is never faster than 250 mm/s (ISO 10218-1).

#pragma once

#include <optional>
#include <string_view>

#include "control/robot/group/enabling_switch.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/plans.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class Jogging {
 public:
  Jogging(Robot& robot, GroupPort& group, Plans& plans) noexcept : robot_(robot), group_(group), plans_(plans) {}

  // Reads the request of this period. `permitted`: by the operating mode and its enabling device. Real-time safe, like
  // all functions of this class.
  void step(const JogRequest& jog, bool permitted) noexcept;
  [[nodiscard]] bool on() const noexcept { return on_; }
  // The motion has ended.
  void end() noexcept { on_ = false; }
  // No motion in that direction is possible until another one is requested.
  void block() noexcept { blocked_ = true; }
  // The motion was not possible: tries a shorter one; after some attempts jogging counts as blocked.
  void try_shorter() noexcept;

 private:
  // Returns whether the robot does nothing but what this switch requests. Else something else has stopped it, or moved
  // it, and the switch has to be released first.
  [[nodiscard]] bool is_free() const noexcept;
  void begin() noexcept;
  [[nodiscard]] std::optional<Quat> axes_of(const JogRequest& jog) const noexcept;
  [[nodiscard]] const WorkFrame* work_frame(std::string_view name) const noexcept;
  [[nodiscard]] MoveCommand axis_motion(int axis, double part) const noexcept;
  [[nodiscard]] MoveCommand tip_motion(int direction, double part) const noexcept;

  Robot& robot_;
  GroupPort& group_;
  Plans& plans_;
  EnablingSwitch enabling_switch_;
  bool on_ = false;
  bool blocked_ = false;
  bool own_stop_ = false;  // the robot comes to rest because the request has changed
  double part_ = 1;        // part of the longest distance
  JogFrame frame_ = JogFrame::Joint;
  Quat axes_ = Quat::Identity();  // of the frame
  int index_ = -1;                // of the axis or the direction; -1: no jogging is requested
  double speed_ = 0;              // part of the maximum speed, with its sign
};

}  // namespace indurop::robot
