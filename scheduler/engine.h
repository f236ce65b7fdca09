// SPDX-License-Identifier: Apache-2.0
// The scheduler of one node: tick threads on one absolute time grid, bands below them, event handler, watchdog.

#pragma once

#include <array>
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
#include "scheduler/change_proposal.h"
#include "scheduler/engine_settings.h"
#include "scheduler/retirement.h"
#include "scheduler/schedule.h"

namespace indurop::scheduler {

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

  // Another schedule takes over while the engine runs, on all cores before the same tick. The same thread as for
  // disable(), which is not called meanwhile from Waiting on.
  enum class Change : std::uint8_t {
    None,
    Starting,  // its threads start
    Prepared,  // they wait
    Waiting,   // for its first tick
    Leaving,   // it runs; runs of the schedule before may be in progress
  };
  // Adds a module that no schedule has yet, or replaces the code of one that none has any more. There is room for
  // kSpareModules.
  void offer(const Task& task);
  // Returns true if modules can run on this core without a restart.
  [[nodiscard]] bool has_core(int number) const noexcept;
  // Builds the schedule of these tasks, which refer to modules of this engine on the cores on which they run; `run` and
  // `condition` do not count. Modules that are new in it get their FIFO priorities at once. Errors: Busy (another
  // change is in progress), InvalidArgument (another module, another core), those of rt::Thread::start().
  Status prepare_change(std::span<const Task> tasks);
  // Called when it is Prepared. From the first moment of `tick` on the prepared schedule counts; its releases are
  // counted from tick 0, as all are. On one core it waits for a tick in which no run of the periodic modules is in
  // progress, in steps of `step` ticks, and is Prepared again if there is none until `last`. On several cores it does
  // not wait: a module whose run by the schedule before is in progress then is left out until it is over, and that is
  // counted as skipped. Returns false if a core has begun that tick: nothing has changed, choose a later one.
  bool change_at(const ChangeProposal::Time& time) noexcept;
  // Ends what was prepared. Has no effect from Waiting on.
  void drop_change() noexcept;
  // Continues, and returns where it is. Called repeatedly until None.
  Change follow_change() noexcept;
  // First tick of the schedule that took over last.
  [[nodiscard]] std::uint64_t changed_at() const noexcept { return changed_at_; }

  // After finished() or request_stop(): waits for all threads, ends modules that do not return, completes statistics.
  void join() noexcept;

  // Returns the band that runs a module, by its index in the block's records. Null: none, or the scheduler does not see
  // the end of its runs (a process that handles events, or is woken by a signal). Lives until the schedule changes.
  [[nodiscard]] const Band* band_of(std::uint32_t module) const noexcept { return schedule_->find_band(module); }

  // Changes with every run of one of these modules, and is odd from a release until the runs of its band are over,
  // whichever schedule counts. Real-time safe, any thread.
  [[nodiscard]] std::uint64_t activity_of(std::span<const std::uint32_t> modules) const noexcept;

  // Runs one tick with everything on the calling thread and no threads: for tests with a clock of their own.
  void step(std::uint64_t tick, rt::MonoTime epoch) noexcept;

 private:
  struct Core;
  Core& core(int number);
  void add_state(const Task& task);
  [[nodiscard]] Schedule::Parts schedule_parts();
  [[nodiscard]] TaskState* thread_module(std::uint32_t module) const noexcept;
  Status start_watchdog();
  void tick_loop(Core& core, std::uint64_t ticks) noexcept;
  void end_run(Core& core, std::uint64_t ticks, std::uint64_t lost) noexcept;
  void do_tick(Core& core, std::uint64_t tick, std::uint64_t lost) noexcept;
  std::uint64_t follow(Core& core, std::uint64_t tick, std::uint64_t lost) noexcept;
  void take_over(Core& core, std::uint64_t tick) noexcept;
  void note_change() noexcept;
  bool follow_retirement() noexcept;
  void watchdog_loop() noexcept;

  RunBlock& block_;
  EngineSettings settings_;
  Hooks hooks_;
  Kernel& kernel_;
  std::vector<std::unique_ptr<TaskState>> states_;
  std::vector<std::unique_ptr<Core>> cores_;  // the primary core first
  std::unique_ptr<Schedule> schedule_;
  std::vector<std::unique_ptr<KernelThread>> threads_;  // of the ticks
  std::unique_ptr<KernelThread> watchdog_;
  // A change of the schedule.
  std::unique_ptr<Schedule> next_;  // prepared
  ChangeProposal proposal_;         // its tick
  std::uint64_t changed_at_ = 0;
  Retirement retirement_;                                  // of the schedule before, or of one that was dropped
  std::array<std::atomic<const Schedule*>, 2> watched_{};  // by the watchdog, and by activity_of()
  mutable std::atomic<int> readers_{0};                    // in activity_of()
  std::atomic<std::uint64_t> watchdog_passes_{0};
  std::atomic<bool> stop_{false};
  std::atomic<bool> stop_watchdog_{false};
  std::atomic<int> ticking_{0};
};

}  // namespace indurop::scheduler
