// SPDX-License-Identifier: Apache-2.0
// The scheduler of one node: tick threads on one absolute time grid, bands below them, event handler, watchdog.

#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/rt/thread.h"
#include "scheduler/band.h"
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
};

class Engine {
 public:
  // The module records of `block` are filled in; tasks refer to them by index. Writes fifo_priority into the records.
  // Not real-time safe.
  Engine(RunBlock& block, std::span<const Task> tasks, const EngineSettings& settings, const Hooks& hooks,
         Kernel& kernel);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  // Starts all threads. Tick 0 comes after a warm-up without modules; `ticks` = 0 runs until stop.
  // Errors: System, NoSpace (threads could not be created; nothing runs then).
  Status start(std::uint64_t ticks);

  // Ends the run at the next tick. Real-time safe, any thread, any number of times.
  void request_stop() noexcept { stop_.store(true, std::memory_order_release); }
  // From now on no module is entered, and the run ends at the next tick. Any thread; safe in a signal handler.
  void halt() noexcept;
  [[nodiscard]] bool stopping() const noexcept { return stop_.load(std::memory_order_acquire) || finished(); }
  [[nodiscard]] bool finished() const noexcept { return ticking_.load(std::memory_order_acquire) == 0; }

  // Takes a thread module out of the schedule: it is no longer entered and its place stays empty, so the others keep
  // theirs. A run in progress goes on; at_rest() returns true when none is left. Returns false for other modules.
  // disable(), at_rest() and enable() are called by one normal thread.
  bool disable(std::uint32_t module) noexcept;
  // Returns true if no run is in progress. Ends a run that takes longer than the grace of a stopping node, as a fault.
  [[nodiscard]] bool at_rest(std::uint32_t module) noexcept;
  void enable(std::uint32_t module) noexcept;

  // Lets `exchange` (borrowed) decide which version of a thread module is entered, until unwatch(). Both return false
  // if the module is not entered at all. Once has_passed() returns true after them, no run that began before is in
  // progress. The same thread as for disable().
  bool watch(std::uint32_t module, Exchange& exchange) noexcept;
  bool unwatch(std::uint32_t module) noexcept;
  [[nodiscard]] bool has_passed(std::uint32_t module) const noexcept;
  // Replaces the code of a module that is not entered and is at_rest().
  void replace_closed(std::uint32_t module, const Exchange::Code& code) noexcept;

  // For a thread module of the schedule: a number that has changed when its code was entered since; nullopt while it is
  // being executed. Any thread.
  [[nodiscard]] std::optional<std::uint64_t> entries_if_outside(std::uint32_t module) const noexcept;

  // Ends the runs in progress as faults of their modules, however short they have run. Any thread.
  void end_runs_in_progress() noexcept;

  // After finished() or request_stop(): waits for all threads, ends modules that do not return, completes statistics.
  void join() noexcept;

  // Returns the band that runs a module, by its index in the block's records. Null: none, or the scheduler does not see
  // the end of its runs (a process that handles events, or is woken by a signal). Lives as long as the engine.
  [[nodiscard]] const Band* band_of(std::uint32_t module) const noexcept { return find_band(module); }

  // Runs one tick with everything on the calling thread and no threads: for tests with a clock of their own.
  void step(std::uint64_t tick, rt::MonoTime epoch) noexcept;

 private:
  struct Core;
  void build_periodic(const std::vector<TaskState*>& periodic);
  void build_sporadic(const std::vector<TaskState*>& sporadic);
  void add_band(const BandPlan& plan, std::vector<TaskState*> tasks, std::vector<TaskState*> processes = {});
  void connect_predecessors();
  Core& core(int number);
  [[nodiscard]] TaskState* thread_module(std::uint32_t module) const noexcept;
  [[nodiscard]] Band* find_band(std::uint32_t module) const noexcept;
  Status start_band_threads();
  Status start_watchdog();
  void tick_loop(Core& core, std::uint64_t ticks) noexcept;
  void end_run(Core& core, std::uint64_t ticks, std::uint64_t lost) noexcept;
  void do_tick(Core& core, std::uint64_t tick, std::uint64_t lost) noexcept;
  void wake_waiting() noexcept;
  void watchdog_loop() noexcept;
  [[nodiscard]] std::int64_t epoch_ns() const noexcept { return block_.epoch_ns.load(std::memory_order_relaxed); }

  RunBlock& block_;
  EngineSettings settings_;
  Hooks hooks_;
  Kernel& kernel_;
  std::vector<std::unique_ptr<TaskState>> states_;
  std::vector<std::unique_ptr<Core>> cores_;  // the primary core first
  std::vector<std::unique_ptr<Band>> bands_;  // periodic ones in execution order, then after-base, then event handler
  std::vector<std::unique_ptr<KernelThread>> threads_;
  std::unique_ptr<KernelThread> watchdog_;
  bool gated_ = false;  // bands wait for their predecessors explicitly
  std::atomic<bool> stop_{false};
  std::atomic<bool> stop_watchdog_{false};
  std::atomic<int> ticking_{0};
};

}  // namespace indurop::scheduler
