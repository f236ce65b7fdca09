// SPDX-License-Identifier: Apache-2.0
// A short wake-up test: how late a thread like the node's tick thread is scheduled.

#pragma once

#include <cstdint>
#include <memory>

#include "scheduler/run_block.h"

namespace indurop::tools {

struct LatencyTest {
  std::int64_t duration_ns = 2'000'000'000;
  std::int64_t period_ns = 1'000'000;
};

struct LatencyResult {
  std::unique_ptr<scheduler::Distribution> lateness;
  bool real_time = false;  // SCHED_FIFO was granted
};

// Ends early on Ctrl-C. Only sleeps; does not spin as the node does.
LatencyResult measure_latency(const LatencyTest& test);

}  // namespace indurop::tools
