// SPDX-License-Identifier: Apache-2.0
// Which module runs on which core, and in which order, so that all end in time and no core is busy for longer than
// needed. What shares data stays on one core unless told otherwise, so it keeps its order there and waits for nobody.
// Small schedules are searched through, large ones are improved until nothing helps. The same problem gives the same
// answer on every machine. Pure arithmetic.

#pragma once

#include <cstdint>
#include <vector>

#include "scheduler/response_time.h"

namespace indurop::scheduler {

struct Placeable {
  Nanos period{};
  Nanos offset{};
  Nanos execution{};  // longest
  Nanos deadline{};   // from its release
  int core = -1;      // it is bound to; -1: any
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
  // By module. Changed only if it does not hold otherwise, and for modules that share data by the same time.
  std::vector<Nanos> offset;
  // Modules, first to last. As given unless it does not hold otherwise, or, with split_sharing, a core is done earlier;
  // what shares data keeps its order.
  std::vector<std::uint32_t> order;
  bool holds = false;  // every module ends by its deadline
  Nanos busiest{};     // WorstResponses::busiest
};

// 256 modules on 64 cores take less than a second. Not real-time safe.
Placement place(const PlacementProblem& problem);

}  // namespace indurop::scheduler
