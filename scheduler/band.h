// SPDX-License-Identifier: Apache-2.0
// One band at run time: its releases, what happens when a run is not done by the next release, and which bands must
// finish first.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/rt/signal_word.h"
#include "scheduler/bands.h"
#include "scheduler/runner.h"

namespace indurop::scheduler {

struct Release {
  std::uint64_t tick = 0;
  rt::MonoTime time;
};

// Returns true if a run of the module by the schedule before may be in progress. Real-time safe, any thread.
bool is_leaving(const TaskState& state) noexcept;

class Band {
 public:
  // Maximum number of outstanding releases under OverrunPolicy::CatchUp; more are skipped.
  static constexpr std::uint64_t kBacklog = 16;

  // `processes`: sporadic process modules that a Handler band signals after its threads (chapter, Figure 6).
  Band(const BandPlan& plan, std::vector<TaskState*> tasks, std::vector<TaskState*> processes, RunBlock& block,
       Kernel& kernel, const Hooks& hooks, CoreTrace& trace, std::int64_t basic_period_ns);

  [[nodiscard]] const BandPlan& plan() const noexcept { return plan_; }
  [[nodiscard]] bool due(std::uint64_t tick) const noexcept {
    return tick >= grid_.offset && (tick - grid_.offset) % grid_.period == 0;
  }

  // Bands that must have finished their part of a tick before this one starts it, nearest last. Set once, before start.
  void set_predecessors(std::vector<Band*> bands) { predecessors_ = std::move(bands); }
  // Returns true if the band waits for predecessors. A process module then has a thread here, too, which wakes it when
  // they are done.
  [[nodiscard]] bool waits_for_others() const noexcept { return !predecessors_.empty(); }

  // Tick thread: releases what is due in ticks (last seen, tick]. Several missed releases become one, the rest are
  // counted as skipped.
  void release_due(std::uint64_t tick, rt::MonoTime epoch) noexcept;

  // Tick thread, at the end of the run: counts as skipped the releases due in ticks before `end_tick` that never began.
  void miss_due(std::uint64_t end_tick) noexcept;

  // Tick thread, only for bands that run in it: runs the band at once. `lost` = ticks that never began.
  void run_inline(std::uint64_t tick, rt::MonoTime release, std::uint64_t lost) noexcept;

  // Tick thread, when another schedule takes over with this tick. The band of the schedule before: what was due in
  // earlier ticks and was not released never will be. That of the new one: nothing before the tick is due. Its tasks
  // that are leaving are left out until they have left.
  void leave_at(std::uint64_t tick) noexcept;
  void begin_at(std::uint64_t tick) noexcept;

  // Body of the band thread (for a process: of the thread that waits in its place). Returns when stop() was called.
  void loop() noexcept;
  void stop() noexcept;
  // The part of loop() between two sleeps: runs every outstanding release whose predecessors are done.
  void drain() noexcept;

  // Number of releases so far, and whether all up to `release` are done: for a caller that waits until a module that is
  // no longer entered has left. Any thread.
  [[nodiscard]] std::uint64_t released() const noexcept { return released_.load(std::memory_order_seq_cst); }
  [[nodiscard]] bool has_done(std::uint64_t release) const noexcept {
    return done_.load(std::memory_order_seq_cst) >= release;
  }

  // Returns true if releases have not been started, or a run is in progress. Any thread.
  [[nodiscard]] bool is_busy() const noexcept;

  // If the band sleeps until a predecessor is done, it checks again. Any thread.
  void check_again() noexcept;

  // Changes with every run; odd from a release until its run is over. Real-time safe, any thread.
  [[nodiscard]] std::uint64_t activity() const noexcept;

  [[nodiscard]] Runner& runner() noexcept { return runner_; }
  [[nodiscard]] std::span<TaskState* const> tasks() const noexcept { return tasks_; }
  [[nodiscard]] std::span<TaskState* const> processes() const noexcept { return processes_; }
  // Sets the callback for when the band has finished a tick and others may wait for it.
  void set_done_callback(void (*callback)(void*) noexcept, void* context) noexcept { on_done_ = {callback, context}; }
  // Counts the last run of a process module and the samples the jitter reference still holds. After the threads ended.
  void finish() noexcept;

 private:
  void release(const Release& release) noexcept;
  void overrun(const Release& release) noexcept;
  void skip(std::uint64_t releases) noexcept;
  static void skip(TaskState& state, std::uint64_t releases) noexcept;
  std::span<TaskState* const> tasks_to_run() noexcept;
  void release_process(TaskState& state, const Release& release) noexcept;
  void account_process(TaskState& state) noexcept;
  void find_inline_overrun(std::uint64_t tick, std::int64_t release_ns) noexcept;
  void apply_policy(TaskState& culprit, std::uint64_t tick, std::int64_t own_ns) noexcept;
  void record_overrun(TaskState& culprit, std::uint64_t tick, bool started, std::int64_t release_ns) noexcept;
  [[nodiscard]] bool outstanding() const noexcept;
  [[nodiscard]] bool gate_open(std::uint64_t tick, bool& poll) const noexcept;
  [[nodiscard]] bool any_enabled() const noexcept;

  BandPlan plan_;
  std::vector<TaskState*> tasks_;
  std::vector<TaskState*> processes_;
  std::vector<TaskState*> arrived_;      // while some are leaving: first those that are not; of constant size
  std::span<TaskState* const> running_;  // those of the run in progress or the last one
  bool some_leave_ = false;
  RunBlock& block_;
  Kernel& kernel_;
  Hooks hooks_;
  CoreTrace& trace_;
  Runner runner_;
  std::int64_t basic_period_ns_;
  struct Grid {
    std::uint64_t period;
    std::uint64_t offset;
  };
  Grid grid_;  // of releases, in ticks
  std::uint64_t next_due_;
  std::uint64_t owed_ = 0;  // inline catch-up: runs still to be made up for
  std::vector<Band*> predecessors_;
  struct DoneCallback {
    void (*function)(void*) noexcept = nullptr;
    void* context = nullptr;
  };
  DoneCallback on_done_;

  rt::SignalWord wake_{};
  std::array<Release, kBacklog> pending_{};
  std::atomic<std::uint64_t> released_{0};
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> decided_tick_{0};  // tick + 1 up to which releases were decided
  std::atomic<bool> waiting_{false};
  std::atomic<bool> stop_{false};
};

}  // namespace indurop::scheduler
