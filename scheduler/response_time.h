// SPDX-License-Identifier: Apache-2.0
// How long modules take at most from their release to their end, from the longest time each of them executes. The whole
// schedule is gone through once, tick by tick: releases are on one grid, who is earlier in the order preempts who is
// later, and with shorter executions nobody ends later (fixed priorities on one processor are sustainable: Baruah and
// Burns, "Sustainable scheduling analysis", 2006). Who waits for another core is taken to keep those behind it on its
// own core waiting, too; they do not, but what is found so is never too short: when all before a module on its core and
// all it waits for are over, nothing keeps it from running. Pure arithmetic.

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
  Nanos execution{};        // longest, preemption and dispatch not counted
  bool own_thread = false;  // it begins a band that the tick thread has to wake
  int core = 0;
  Nanos waiting{};                     // what it costs to be woken by those it waits for
  std::vector<std::uint32_t> after{};  // places of earlier demands on other cores it waits for in a tick
};

// What the platform takes for itself: in each tick, and for waking a thread or process and going back.
struct DispatchCost {
  Nanos tick{};
  Nanos wake{};
};

struct WorstResponses {
  static constexpr Nanos kNotDone{-1};  // not before its next release
  std::vector<Nanos> worst;             // parallel to the demands
  Nanos busiest{};           // from the begin of a tick until a core is done with everything released so far, at most
  bool with_offsets = true;  // false: too many ticks to look at; taken as if all were released at once
};

// `demands`: in order of execution, offsets within their periods. Not real-time safe.
WorstResponses worst_responses(std::span<const Demand> demands, Nanos basic_period, const DispatchCost& cost);

}  // namespace indurop::scheduler
