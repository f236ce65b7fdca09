// SPDX-License-Identifier: Apache-2.0
// What place() is made of: judging a placement, finding an order for one core, and two ways to search.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scheduler/placement.h"

namespace indurop::scheduler {

using Modules = std::vector<std::uint32_t>;  // indices into PlacementProblem::modules

// Fills holds and busiest from core, offset and order.
void judge(const PlacementProblem& problem, Placement& placement);

// An order of `modules`, all on one core, in which each ends by its deadline: the given one if it does, else one that
// Audsley's algorithm (1991) finds, which finds one if there is one. Nothing: there is none, or it would take too long
// to say.
std::optional<Modules> order_that_holds(const PlacementProblem& problem, const Modules& modules,
                                        const std::vector<Nanos>& offsets);

// Modules that share data, directly or through others, are on one core. `move_offsets`: try that, too.
Placement place_together(const PlacementProblem& problem, bool move_offsets);
// Any module on any core; those of other cores that share data with it are waited for.
Placement place_split(const PlacementProblem& problem);

}  // namespace indurop::scheduler
