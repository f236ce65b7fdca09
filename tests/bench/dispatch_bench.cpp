// SPDX-License-Identifier: Apache-2.0
// What the scheduler adds to each module of an inline band: call, clock, statistics, slot log. The argument is the
// number of modules; the cost per module is the difference of two sizes.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "scheduler/run_block_setup.h"
#include "scheduler/runner.h"

namespace {

using namespace indurop::scheduler;

void empty_module() {}

void inline_band(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  RunBlockSetup setup;
  setup.basic_period_ns = 1'000'000;
  setup.macro_period_ns = 1'000'000;
  setup.slot_count = 1;
  setup.modules.resize(count);
  const std::size_t bytes = (run_block_size(setup) + 63) / 64 * 64;
  void* memory = std::aligned_alloc(64, bytes);
  std::memset(memory, 0, bytes);
  auto& block = *static_cast<RunBlock*>(memory);
  init_run_block(block, setup);
  SystemKernel clock;
  CoreTrace trace;
  std::vector<std::unique_ptr<TaskState>> states;
  std::vector<TaskState*> tasks;
  for (std::uint32_t i = 0; i < count; ++i) {
    states.push_back(std::make_unique<TaskState>());
    states.back()->task.index = i;
    states.back()->task.run = empty_module;
    states.back()->record = &block.modules()[i];
    tasks.push_back(states.back().get());
  }
  Runner runner(block, clock, Hooks{}, trace, count);
  runner.attach_thread();
  std::uint64_t tick = 0;
  for (auto _ : state) {
    runner.run(tasks, tick++, clock.now());
  }
  runner.detach_thread();
  std::free(memory);
}
BENCHMARK(inline_band)->Arg(1)->Arg(16)->Arg(256);

void clock_read(benchmark::State& state) {
  SystemKernel clock;
  for (auto _ : state) {
    benchmark::DoNotOptimize(clock.now());
  }
}
BENCHMARK(clock_read);

}  // namespace

BENCHMARK_MAIN();
