// SPDX-License-Identifier: Apache-2.0
// The distance of two solids as FCL finds it, proved. FCL says along which line two bodies are nearest; the planes
// across that line hold them apart, whatever FCL did. The only place that knows FCL, which allocates: not for the tick.

#pragma once

#include <memory>
#include <vector>

#include "robot/solid.h"

namespace indurop::robot {

class Nearest {
 public:
  explicit Nearest(const std::vector<Solid>& parts);
  Nearest(const Nearest&) = delete;
  Nearest& operator=(const Nearest&) = delete;
  ~Nearest();

  // m between parts `a` and `b`, which are where the others say: never more than that, and less by rounding only. Where
  // they meet below 0, as least_distance() has it.
  [[nodiscard]] double distance(int a, int b, const PlacedSolid& at_a, const PlacedSolid& at_b) noexcept;

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace indurop::robot
