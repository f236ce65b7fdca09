// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/held_axes.h"

#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

Held workpiece_axes(const Arm& arm) noexcept {
  Held held = 0;
  for (int i = 0; i < arm.count(); ++i) {
    held |= arm.moves_workpiece(i) ? 1U << static_cast<unsigned>(i) : 0U;
  }
  return held;
}

Held redundant_axes(const Arm& arm) noexcept {
  Held held = workpiece_axes(arm);
  const int count = arm.count() - arm.world_joint();
  int more = count - 6;
  for (int i = 0; i < count && more > 0; ++i) {
    if (arm.axis(i).slides()) {
      held |= 1U << static_cast<unsigned>(i);
      --more;
    }
  }
  for (int i = 0, turning = 0; i < count && more > 0; ++i) {
    turning += arm.axis(i).slides() ? 0 : 1;
    if (!arm.axis(i).slides() && turning >= 3) {
      held |= 1U << static_cast<unsigned>(i);
      --more;
    }
  }
  return held;
}

Joints with_axes(Held axes, const Joints& from, Joints near) noexcept {
  for (int i = 0; i < kAxes; ++i) {
    near[i] = holds(axes, i) ? from[i] : near[i];
  }
  return near;
}

}  // namespace indurop::robot
