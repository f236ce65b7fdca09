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

// The way of the tool that a single axis may follow, in m: its set points of the last period and of this one.
struct ToolTravel {
  LineState before;
  double now = 0;
  bool leads = false;  // the arm has power, and its set points are those of motions
};

// All axes of a row (of the arm, or the single ones), and the gates after them.
struct AxisNeighbours {
  std::span<const AxisControl> axes;
  std::span<const SetPointGate> gates;
  std::span<const Cam> cams;
  const ProfileTables* profiles = nullptr;
  int own = 0;                         // index of this axis, from 0
  int first = 0;                       // index of the first axis of the row among all of them
  const ToolTravel* travel = nullptr;  // null: axes of this row cannot follow the tool

  [[nodiscard]] const AxisControl& axis(int index) const noexcept;
  [[nodiscard]] const SetPointGate& gate(int index) const noexcept { return gates[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const SetPointGate& own_gate() const noexcept { return gate(own); }
};

}  // namespace indurop::robot
