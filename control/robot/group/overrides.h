// SPDX-License-Identifier: Apache-2.0
// Hold and override, for the path and for single axes.

#pragma once

#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/master_sync.h"
#include "control/robot/group/mode_guard.h"
#include "control/robot/group/motion_queue.h"
#include "control/robot/group/path_correction.h"
#include "control/robot/group/robot.h"

namespace indurop::robot {

class Overrides {
 public:
  Overrides(Robot& robot, GroupPort& group, ConveyorTracking& conveyor, PathCorrection& correction) noexcept
      : robot_(robot), conveyor_(conveyor), correction_(correction), sync_(robot, group, conveyor) {}

  // Values above full speed count as full speed; values that are not numbers hold all motions. `interrupted`: by a
  // command. Real-time safe.
  void step(const Inputs& in, bool interrupted, const ModeGuard& mode, bool jogging) noexcept;
  [[nodiscard]] MasterSync& sync() noexcept { return sync_; }
  // Returns whether a value of this period is below 0 or no number.
  [[nodiscard]] bool wrong() const noexcept { return wrong_; }

 private:
  [[nodiscard]] double factor(double given) noexcept;

  Robot& robot_;
  ConveyorTracking& conveyor_;
  PathCorrection& correction_;
  MasterSync sync_;
  bool wrong_ = false;
};

}  // namespace indurop::robot
