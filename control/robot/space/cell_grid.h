// SPDX-License-Identifier: Apache-2.0
// The box that the robots of a node share, divided into cells, and which of them a body occupies. Cells are compared in
// the same way whatever the robots are, so no robot has to know the bodies of another one.

#pragma once

#include <indurop/robot/space.h>

#include <vector>

#include "control/robot/collision/solid.h"

namespace indurop::robot {

class CellGrid {
 public:
  CellGrid() = default;
  // `box`: mm, two opposite corners in the frame of the space. `base`: the pose of the robot's base in that frame, x y
  // z in mm, roll pitch yaw in deg; empty: the same frame.
  CellGrid(const std::vector<double>& box, const std::vector<double>& base);

  // Returns the shortest edge of a cell, in m.
  [[nodiscard]] double edge() const noexcept { return edges_.minCoeff(); }
  // m that bodies may move from where their cells were computed.
  [[nodiscard]] double slack() const noexcept { return edge() / 4; }
  // Adds all cells that come nearer to a body than `more` m, and some that only nearly do. `body`: in the frame of the
  // robot's base, which stands still. Real-time safe.
  void add(const PlacedSolid& body, double more, SpaceCells& cells) const noexcept;

 private:
  static constexpr std::array<int, 3> kCount{32, 32, 32};

  struct Range {
    int first = 0, last = 0;
  };
  [[nodiscard]] Range range(const PlacedSolid& body, double more, int axis) const noexcept;
  [[nodiscard]] Vec3 middle_of(int x, int y, int z) const noexcept;

  Vec3 corner_ = Vec3::Zero();
  Vec3 edges_ = Vec3::Ones();
  double half_diagonal_ = 0;
  Pose base_;
};

// Returns whether there is a cell of `cells` that is not in `except` and is in `other`. Real-time safe.
[[nodiscard]] bool meets(const SpaceCells& cells, const SpaceCells& except, const SpaceCells& other) noexcept;
// Returns whether there is a cell of `cells` in the box.
[[nodiscard]] bool meets(const SpaceCells& cells, const SpaceBox& box) noexcept;
// Returns the smallest box around cells.
[[nodiscard]] SpaceBox box_around(const SpaceCells& cells) noexcept;
// Adds cells to others. Real-time safe.
void join(SpaceCells& to, const SpaceCells& cells) noexcept;

}  // namespace indurop::robot
