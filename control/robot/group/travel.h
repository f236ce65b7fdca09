// SPDX-License-Identifier: Apache-2.0
// How far the tool has gone: the sum of the distances between its set points, whatever has moved it. Single axes follow
// it, and a path that follows a master is measured by it.

#pragma once

#include "control/robot/axis/neighbours.h"
#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

class Travel {
 public:
  // Called once per period when the set points of the arm's drives are known. `leads`: they are those of motions.
  // `arm`: with the tool that is in use now. `followed`: anything may measure by it in this period; if not, the tool
  // counts as resting, which saves two positions of the arm. Real-time safe.
  void step(const Arm& arm, const Joints& set_points, bool leads, bool followed, double seconds) noexcept;
  // In m, from the start of the task. Valid as long as this object.
  [[nodiscard]] const ToolTravel& seen() const noexcept { return seen_; }

 private:
  ToolTravel seen_;
  LineState state_;
  Joints last_ = Joints::Zero();
};

}  // namespace indurop::robot
