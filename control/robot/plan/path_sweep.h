// SPDX-License-Identifier: Apache-2.0
// The cells of the shared space through which a planned motion leads the arm, whatever the pace at which it is
// followed.

#pragma once

#include <atomic>

#include "control/robot/collision/collision_check.h"
#include "control/robot/path/segment.h"
#include "control/robot/space/arm_cells.h"

namespace indurop::robot {

class PathSweep {
 public:
  // `grid`: null if the space is not shared. All are borrowed.
  PathSweep(const Places& places, const JointLimits& joints, const CellGrid* grid) noexcept
      : places_(places), joints_(joints), grid_(grid) {}

  // Sets `cells` to those of a motion, and of the blend that leads from the motion before it into it. `dropped`
  // abandons it. Real-time safe, like all functions of this class.
  void sweep(const Segment& segment, const std::atomic<bool>& dropped, SpaceCells& cells) noexcept;
  void add(const Segment& before, const Blend& blend, const Segment& segment, const std::atomic<bool>& dropped,
           SpaceCells& cells) noexcept;

 private:
  const Places& places_;
  const JointLimits& joints_;
  const CellGrid* grid_;
  Segment path_;  // of joints, that is being swept
};

}  // namespace indurop::robot
