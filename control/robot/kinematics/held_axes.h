// SPDX-License-Identifier: Apache-2.0
// The axes that a pose leaves undetermined.

#pragma once

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

class Arm;

// Set of axes, one bit each.
using Held = unsigned;
// Returns whether the axis, from 0, is in the set. Real-time safe, like all functions of this file.
constexpr bool holds(Held axes, int axis) noexcept {
  return (axes >> static_cast<unsigned>(axis) & 1U) != 0;
}
// The axes that move the workpiece.
Held workpiece_axes(const Arm& arm) noexcept;
// The redundant axes of an arm with more than six: those of the workpiece, those that slide, else the third, whose
// angle determines where the elbow is.
Held redundant_axes(const Arm& arm) noexcept;
// Returns `near` with these axes as in `from`.
Joints with_axes(Held axes, const Joints& from, Joints near) noexcept;

}  // namespace indurop::robot
