// SPDX-License-Identifier: Apache-2.0
// One module as the scheduler sees it: what to call or which process to wake, and its rules. No files, no names, no
// XML.

#pragma once

#include <indurop/module.h>

#include <cstdint>
#include <vector>

#include "scheduler/run_block.h"

namespace indurop::scheduler {

struct Task {
  std::uint32_t index = 0;  // into RunBlock's modules
  ModuleType type = ModuleType::Thread;
  Operation operation = Operation::Periodic;
  Relaxed<OverrunPolicy> overrun{OverrunPolicy::Skip};
  int priority = 0;  // lowest value first
  int core = 0;
  std::int64_t period_ns = 0;  // periodic only
  std::int64_t offset_ns = 0;
  Relaxed<std::int64_t> budget_ns{0};  // longest allowed execution, 0: no limit
  bool after_base = false;             // sporadic: evaluated directly after the inline band
  Relaxed<std::int64_t> work_ns{0};    // simulation only: how long a run takes; 0: no time
  int legacy_signal = 0;               // process woken by this signal instead of its slot
  void (*run)() = nullptr;             // thread modules
  Condition condition;                 // sporadic thread modules
  // CoreOrder::Data: tasks (by `index`, earlier in the order) that must be done with a tick before this one begins it.
  // No effect between tasks of one core, which are in order anyway.
  std::vector<std::uint32_t> after;
};

}  // namespace indurop::scheduler
