// SPDX-License-Identifier: Apache-2.0
// Groups of modules that share data, directly or through others, and their work in each tick.

#pragma once

#include <cstdint>
#include <vector>

#include "scheduler/core_loads.h"

namespace indurop::scheduler {

class LoadUnits {
 public:
  LoadUnits(const PlacementProblem& problem, bool move_offsets);

  [[nodiscard]] const std::vector<LoadUnit>& all() const noexcept { return units_; }  // those with most work first
  [[nodiscard]] std::int64_t ticks() const noexcept { return ticks_; }

 private:
  void complete(LoadUnit& unit, bool move_offsets) const;

  const PlacementProblem& problem_;
  std::int64_t ticks_;
  std::vector<LoadUnit> units_;
};

}  // namespace indurop::scheduler
