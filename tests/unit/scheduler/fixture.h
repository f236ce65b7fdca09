// SPDX-License-Identifier: Apache-2.0
// A run block in private memory and a clock that only moves on command, for scheduler tests.

#pragma once

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "scheduler/engine.h"
#include "scheduler/run_block_setup.h"

namespace indurop::scheduler {

class VirtualClock final : public Kernel {
 public:
  rt::MonoTime now() noexcept override { return rt::mono_time(now_); }
  void sleep_until(rt::MonoTime deadline) noexcept override { now_ = std::max(now_, rt::to_ns(deadline)); }
  void advance(std::int64_t ns) noexcept { now_ += ns; }

 private:
  std::int64_t now_ = 1'000'000;
};

struct FreeMemory {
  void operator()(RunBlock* block) const noexcept {
    std::free(block);
  }  // NOLINT(cppcoreguidelines-no-malloc): of aligned_alloc
};
using BlockPointer = std::unique_ptr<RunBlock, FreeMemory>;

inline BlockPointer make_block(const RunBlockSetup& setup) {
  const std::size_t bytes = run_block_size(setup);
  const std::size_t aligned = (bytes + 63) / 64 * 64;
  BlockPointer block(static_cast<RunBlock*>(std::aligned_alloc(64, aligned)));
  std::memset(static_cast<void*>(block.get()), 0, aligned);
  init_run_block(*block, setup);
  return block;
}

inline BlockPointer make_block(const std::vector<Task>& tasks, std::int64_t basic_ns, std::int64_t macro_ns) {
  RunBlockSetup setup;
  setup.node_name = "test";
  setup.basic_period_ns = basic_ns;
  setup.macro_period_ns = macro_ns;
  setup.slot_count = static_cast<std::uint64_t>(macro_ns / basic_ns);
  for (const Task& task : tasks) {
    ModuleSetup module;
    module.name = "m" + std::to_string(task.index);
    module.type = task.type;
    module.operation = task.operation;
    module.overrun = task.overrun;
    module.priority = task.priority;
    module.period_ns = task.period_ns;
    module.budget_ns = task.budget_ns;
    setup.modules.push_back(module);
  }
  return make_block(setup);
}

// Tasks numbered 0.. in the given order.
inline Task periodic(std::uint32_t index, std::int64_t period_ns, int priority, void (*run)()) {
  Task task;
  task.index = index;
  task.period_ns = period_ns;
  task.priority = priority;
  task.run = run;
  return task;
}

}  // namespace indurop::scheduler
