// SPDX-License-Identifier: Apache-2.0
// What an axis knows of the others, to follow them.

#pragma once

#include <indurop/robot/controller.h>

#include <cstddef>
#include <span>

#include "control/robot/axis/cam.h"
#include "control/robot/axis/set_point_gate.h"

namespace indurop::robot {

class AxisControl;

// All axes of the arm, and the gates after them.
struct AxisNeighbours {
  std::span<const AxisControl> axes;
  std::span<const SetPointGate> gates;
  std::span<const Cam> cams;
  const ProfileTables* profiles = nullptr;
  int own = 0;  // index of this axis, from 0

  [[nodiscard]] const AxisControl& axis(int index) const noexcept;
  [[nodiscard]] const SetPointGate& gate(int index) const noexcept { return gates[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const SetPointGate& own_gate() const noexcept { return gate(own); }
};

}  // namespace indurop::robot
