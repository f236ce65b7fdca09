// SPDX-License-Identifier: Apache-2.0
// Chooses the core and the order for each module, so that all end in time and no core is busy for longer than needed.
// Modules that share data stay on one core unless configured otherwise, so they keep their order there and wait for no
// other core. Small schedules are searched completely, large ones are improved until no step helps. The same problem
// gives the same answer on every machine. Pure arithmetic.

#pragma once

#include <cstdint>
#include <vector>

#include "scheduler/response_time.h"

namespace indurop::scheduler {

struct Placeable {
  Nanos period{};
  Nanos offset{};
  Nanos execution{};  // longest execution time
  Nanos deadline{};   // from its release
  int core = -1;      // core the module is bound to; -1: any
  bool keeps_offset = false;
  std::vector<std::uint32_t> shares{};  // modules before it in the order that it shares data with
};

struct PlacementProblem {
  std::vector<Placeable> modules;  // in order of execution
  int cores = 1;
  Nanos basic_period{};
  DispatchCost cost;
  bool split_sharing = false;  // modules that share data may be on different cores
};

struct Placement {
  std::vector<int> core;  // by module
  // By module. Changed only if the deadlines do not hold otherwise, and by the same time for modules that share data.
  std::vector<Nanos> offset;
  // Modules, first to last. In the given order unless the deadlines do not hold otherwise, or, with split_sharing, a
  // core is done earlier; modules that share data keep their order.
  std::vector<std::uint32_t> order;
  bool holds = false;  // every module ends by its deadline
  Nanos busiest{};     // WorstResponses::busiest
};

// 256 modules on 64 cores take less than a second. Not real-time safe.
Placement place(const PlacementProblem& problem);

}  // namespace indurop::scheduler
