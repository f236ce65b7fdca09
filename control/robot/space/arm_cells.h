// SPDX-License-Identifier: Apache-2.0
// The cells that the bodies of an arm and its tool occupy at joint positions, or anywhere near them.

#pragma once

#include "control/robot/collision/clearance.h"
#include "control/robot/space/cell_grid.h"

namespace indurop::robot {

class ArmCells {
 public:
  // Both are borrowed; the bodies may be exchanged.
  ArmCells(const Clearance& clearance, const CellGrid& grid) noexcept : clearance_(clearance), grid_(grid) {}

  [[nodiscard]] const CellGrid& grid() const noexcept { return grid_; }
  // Adds the cells of all bodies at joint positions that differ from `q` by `around` at most, each axis by its own, and
  // `more` m around the bodies. Real-time safe, like all functions of this class.
  void add(const Joints& q, const Joints& around, int tool, double more, SpaceCells& cells) const noexcept;
  // Adds the cells of all bodies on the way from one place to another, on which each axis moves as it likes.
  void add_way(const Joints& from, const Joints& to, int tool, double more, SpaceCells& cells) const noexcept;
  // m that a point of a body moves at most when the axes move by that much.
  [[nodiscard]] double most_moved(const Joints& moved, int tool) const noexcept;

 private:
  [[nodiscard]] bool counts(std::size_t part, int tool) const noexcept {
    const Clearance::Part& one = clearance_.parts()[part];
    return clearance_.is_of_arm(part) && (one.tool == 0 || one.tool == tool);
  }

  const Clearance& clearance_;
  const CellGrid& grid_;
};

}  // namespace indurop::robot
