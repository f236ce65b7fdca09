// SPDX-License-Identifier: Apache-2.0
// The settings of an engine, which hold for as long as it runs.

#pragma once

#include <atomic>
#include <cstdint>

#include "scheduler/core_order.h"
#include "scheduler/tick_wait.h"

namespace indurop::scheduler {

struct EngineSettings {
  std::int64_t basic_period_ns = 0;
  int primary_core = 0;
  CoreOrder order = CoreOrder::Total;
  bool realtime = true;  // false: SCHED_FIFO is not available; the order is then kept by waiting
  SpinSettings spin;
  // Tick 0 falls on a time that leaves the remainder `phase_ns` when divided by `grid_ns` (0: as soon as possible).
  std::int64_t grid_ns = 0;
  std::int64_t phase_ns = 0;
  std::int64_t stop_grace_ns = 1'000'000'000;  // how long a module may still run once the node stops
  // Counts by how much the watchdog is woken late: meanwhile, the machine runs nothing of the node. Borrowed, may be
  // null.
  std::atomic<std::int64_t>* stalled_ns = nullptr;
};

}  // namespace indurop::scheduler
