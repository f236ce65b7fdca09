// SPDX-License-Identifier: Apache-2.0
// The distance of two solids as FCL finds it, and verified. FCL returns the line along which two bodies are nearest;
// planes across that line separate them, which proves the distance independently of FCL. The only file that knows FCL,
// which allocates: not for the tick.

#pragma once

#include <memory>
#include <vector>

#include "control/robot/collision/solid.h"

namespace indurop::robot {

class Nearest {
 public:
  explicit Nearest(const std::vector<Solid>& parts);
  Nearest(const Nearest&) = delete;
  Nearest& operator=(const Nearest&) = delete;
  ~Nearest();

  // Distance in m between parts `a` and `b` at the given places: never too large, and too small by rounding only. Below
  // 0 where they intersect, as in least_distance().
  [[nodiscard]] double distance(int a, int b, const PlacedSolid& at_a, const PlacedSolid& at_b) noexcept;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace indurop::robot
