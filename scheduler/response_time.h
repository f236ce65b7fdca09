// SPDX-License-Identifier: Apache-2.0
// The longest time of modules from their release to their end, computed from the longest execution time of each. The
// whole schedule is simulated once, tick by tick: releases are on one grid, a module earlier in the order preempts
// later ones, and with shorter executions no module ends later (fixed priorities on one processor are sustainable:
// Baruah and Burns, "Sustainable scheduling analysis", 2006). A module that waits for another core is assumed to keep
// the later ones on its own core waiting, too; they do not wait, but the result is never too short: when all modules
// before it on its core and all it waits for are done, nothing keeps a module from running. For the same reason none
// ends later than it would if all ran on one core. Pure arithmetic.

#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "scheduler/period_table.h"

namespace indurop::scheduler {

struct Demand {
  Nanos period{};
  Nanos offset{};
  Nanos execution{};        // longest, without preemption and dispatch
  bool own_thread = false;  // it begins a band that the tick thread has to wake
  int core = 0;
  Nanos waiting{};                     // cost of being woken by those it waits for
  std::vector<std::uint32_t> after{};  // indices of earlier demands on other cores it waits for in a tick
};

// Time the platform itself uses: in each tick, and for waking a thread or process and returning.
struct DispatchCost {
  Nanos tick{};
  Nanos wake{};
};

struct WorstResponses {
  static constexpr Nanos kNotDone{-1};  // not done before its next release
  std::vector<Nanos> worst;             // parallel to the demands
  Nanos busiest{};  // from the begin of a tick until a core is done with everything released so far, at most
  // false: too many ticks to check; computed as if all were released at once, and were on one core if any waits for
  // another one. No response is longer than this.
  bool with_offsets = true;
};

// `demands`: in order of execution, offsets within their periods. Not real-time safe.
WorstResponses worst_responses(std::span<const Demand> demands, Nanos basic_period, const DispatchCost& cost);

}  // namespace indurop::scheduler
