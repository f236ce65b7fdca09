// SPDX-License-Identifier: Apache-2.0
// The parts of place(): judging a placement, finding an order for one core, and two ways to search.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scheduler/placement.h"

namespace indurop::scheduler {

using Modules = std::vector<std::uint32_t>;  // indices into PlacementProblem::modules

// Fills `holds` and `busiest` from core, offset and order.
void judge(const PlacementProblem& problem, Placement& placement);

// Returns an order of `modules`, all on one core, in which each ends by its deadline: the given one if it does, else
// the result of Audsley's algorithm (1991), which finds one if there is one. Nothing: there is none, or finding out
// would take too long.
std::optional<Modules> order_that_holds(const PlacementProblem& problem, const Modules& modules,
                                        const std::vector<Nanos>& offsets);

// Keeps modules that share data, directly or through others, on one core. `move_offsets`: also try other offsets.
Placement place_together(const PlacementProblem& problem, bool move_offsets);
// Places any module on any core; a module waits for those on other cores that share data with it.
Placement place_split(const PlacementProblem& problem);

}  // namespace indurop::scheduler
