// SPDX-License-Identifier: Apache-2.0
// The last checks before the drives: one for each axis, one for the box that the tool must not leave, one for manual
// mode and one for collisions. Where a set point is rejected, or a path can no longer be followed, the axes brake here.

#pragma once

#include "control/robot/group/collisions_ahead.h"
#include "control/robot/group/group_port.h"
#include "control/robot/group/mode_guard.h"
#include "control/robot/group/off_path.h"
#include "control/robot/group/robot.h"
#include "control/robot/group/shared_space.h"
#include "control/robot/path/joint_brake.h"

namespace indurop::robot {

class LastGate {
 public:
  LastGate(Robot& robot, GroupPort& group, const ModeGuard& mode, SharedSpace& space, const OffPath& off_path)
      : robot_(robot),
        group_(group),
        mode_(mode),
        space_(space),
        off_path_(off_path),
        clear_(robot),
        brake_(robot.parts.joints) {}

  // Every set point passes through here before it reaches a drive. One that is rejected is reported as the end of the
  // path, which has to lead to begin_braking(). Real-time safe, like all functions of this class.
  void pass() noexcept;
  // Return whether it would let the set point of one axis pass, by its limits; and those of all axes, also as far as
  // they come to rest from there, each one on its own, in the workspace, clear of everything and with a slow tip.
  [[nodiscard]] bool passes(int axis) const noexcept;
  [[nodiscard]] bool passes() noexcept;
  // The axes brake from here on, in step or each one on its own, with hardness().
  void begin_braking(bool in_step) noexcept;

  // Factor on the joints' accelerations in the stop in progress.
  [[nodiscard]] double hardness() const noexcept { return hardness_; }
  void set_hardness(double hardness) noexcept { hardness_ = hardness; }
  [[nodiscard]] CollisionsAhead& clear() noexcept { return clear_; }

 private:
  void check_axes() noexcept;
  void check_clear() noexcept;
  void check_space() noexcept;
  void send() noexcept;
  [[nodiscard]] bool leaves_workspace() const noexcept;
  [[nodiscard]] bool rests_inside(const Vec3& start) const noexcept;
  void brake() noexcept;
  [[nodiscard]] bool rests_slowly() const noexcept;

  Robot& robot_;
  GroupPort& group_;
  const ModeGuard& mode_;
  SharedSpace& space_;
  const OffPath off_path_;
  CollisionsAhead clear_;
  bool braking_ = false;
  bool in_step_ = false;  // all axes together, by `brake_`
  JointBrake brake_;
  double hardness_ = 1;
};

}  // namespace indurop::robot
