// SPDX-License-Identifier: Apache-2.0
// What moves set points away from the planned path: belts, corrections of jobs, and a hand that guides the arm.

#pragma once

#include "control/robot/group/conveyor_tracking.h"
#include "control/robot/group/guiding.h"
#include "control/robot/group/path_correction.h"

namespace indurop::robot {

struct OffPath {
  ConveyorTracking& conveyor;
  PathCorrection& correction;
  const Guiding& guiding;

  // Returns whether set points may be elsewhere than planned.
  [[nodiscard]] bool any() const noexcept { return conveyor.on() || correction.shifts() || guiding.on(); }
  // Returns whether the set points rest if the path does.
  [[nodiscard]] bool at_rest() const noexcept { return !conveyor.on() && correction.at_rest() && !guiding.on(); }
};

}  // namespace indurop::robot
