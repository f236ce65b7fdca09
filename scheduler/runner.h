// SPDX-License-Identifier: Apache-2.0
// Executes thread modules one after the other on the calling real-time thread, measures them, and keeps a fault of one
// (exception, crash, intervention of the watchdog) from affecting the others.

#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/rt/guard.h"
#include "core/rt/thread.h"
#include "scheduler/exchange.h"
#include "scheduler/kernel.h"
#include "scheduler/statistics.h"
#include "scheduler/task.h"

namespace indurop::scheduler {

// Whether the thread that runs a module enters it.
enum class Gate : std::uint8_t {
  Closed,  // stopped or faulted
  Open,
  Watched,  // its Exchange decides before each run which version is entered
};

class Band;

// A task and its state while it runs. The address stays fixed for the life of the engine. Another schedule changes its
// overrun policy, budget and work only: its order and times are those of the schedule's bands.
struct TaskState {
  Task task;
  ModuleRecord* record = nullptr;
  ProcessSlot* slot = nullptr;  // process modules
  JitterReference jitter;
  std::atomic<Gate> gate{Gate::Open};
  Exchange* exchange = nullptr;    // while Watched; borrowed
  std::uint64_t last_release = 0;  // last release of its band that may have entered it before its gate was changed
  // Its band in the schedule before, whose runs may be in progress; null: there is none.
  std::atomic<const Band*> leaving{nullptr};
  std::uint64_t accounted = 0;  // process modules: last release whose run was counted
  bool logged = true;           // false: its runs are not part of the schedule and stay out of the slot log

  [[nodiscard]] bool is_closed() const noexcept { return gate.load(std::memory_order_relaxed) == Gate::Closed; }
};

// Callbacks into the embedding program, called on real-time threads: no allocation, no lock, no system call.
struct Hooks {
  void* context = nullptr;
  // The module's code is entered next, for its run of this tick and release.
  void (*entering)(void* context, std::uint32_t module, std::uint64_t tick, std::int64_t release_ns) noexcept = nullptr;
  // The module is entered, or its condition evaluated, a few modules later: for loading its data into the cache.
  void (*soon)(void* context, std::uint32_t module) noexcept = nullptr;
  // A run of a thread module begins: its condition, if it has one, was true. Returns true if the callback took longer
  // than reading the clock; that time is not counted as execution time.
  bool (*begins)(void* context, std::uint32_t module) noexcept = nullptr;
  // The run is over. Returns true as above; that time is not counted for the run that follows.
  bool (*ended)(void* context, std::uint32_t module, std::uint64_t tick, const RunTimes& times,
                bool faulted) noexcept = nullptr;
  // From the run that is entered next, another version of the module runs.
  void (*exchanged)(void* context, std::uint32_t module) noexcept = nullptr;
  // A basic period has begun; nothing of it has run.
  void (*ticks)(void* context, std::uint64_t tick, std::int64_t release_ns) noexcept = nullptr;
  void (*faulted)(void* context, std::uint32_t module) noexcept = nullptr;  // after the record was filled in
  void (*stop_node)(void* context, std::uint32_t module, const char* reason) noexcept = nullptr;
  // Modules have run and may have written variables; the callback may wake a thread, nothing more.
  void (*worked)(void* context) noexcept = nullptr;
};

// Who ran last on a core: names the predecessor in overrun records.
struct CoreTrace {
  std::atomic<std::int32_t> module{-1};
  std::atomic<std::int64_t> exec_ns{0};
};

// Writes a fault into the module's record. Real-time safe.
void record_fault(ModuleRecord& record, FaultKind kind, std::uint64_t tick, std::string_view text) noexcept;
// Records the fault and calls the hooks. The module is quarantined, unless it is being exchanged and its previous
// version can continue. Real-time safe.
void quarantine(TaskState& state, FaultKind kind, std::uint64_t tick, const char* text, const Hooks& hooks) noexcept;

// A thread that runs modules.
struct ModuleThread {
  pthread_t handle{};
  rt::StackBounds stack;
  // The calling one. Not real-time safe.
  static ModuleThread own() noexcept { return {::pthread_self(), rt::own_stack()}; }
};

class Runner {
 public:
  Runner(RunBlock& block, Kernel& kernel, const Hooks& hooks, CoreTrace& trace, std::size_t max_tasks);

  // Called on the thread that runs modules, before and after its loop. Real-time safe.
  void attach(const ModuleThread& thread) noexcept;
  void attach_thread() noexcept { attach(ModuleThread::own()); }  // not real-time safe
  void detach_thread() noexcept;
  [[nodiscard]] bool is_attached() const noexcept { return attached_.load(std::memory_order_acquire); }

  // Runs the enabled tasks in order. Sporadic ones run only if condition() is true.
  void run(std::span<TaskState* const> tasks, std::uint64_t tick, rt::MonoTime release) noexcept;

  // The task being executed, null if none; readable from other threads.
  [[nodiscard]] TaskState* current() const noexcept { return current_.load(std::memory_order_acquire); }
  [[nodiscard]] std::int64_t current_start() const noexcept { return current_start_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::int32_t previous_module() const noexcept { return previous_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::int64_t previous_exec() const noexcept { return previous_exec_.load(std::memory_order_relaxed); }
  // How often code of a module was entered: a condition, and the run that it led to, count once. Any thread.
  [[nodiscard]] std::uint64_t entries() const noexcept { return guard_.current_run(); }
  // Times of the task at `position` in the last run(); its end is 0 if it did not run.
  [[nodiscard]] const RunTimes& times(std::size_t position) const noexcept { return times_[position]; }

  // Ends the module in progress if it exceeds its budget, or `grace_ns` once the node is stopping. `late_ns`: by how
  // much the watchdog was woken late, during which the machine ran nothing of the node, so it does not count. One
  // watchdog thread passes it, any thread may pass 0.
  void enforce_budget(rt::MonoTime now, bool stopping, std::int64_t grace_ns, std::int64_t late_ns = 0) noexcept;

 private:
  void call_current() noexcept;
  void call_watched() noexcept;
  template <bool kVirtualTime>
  void call() noexcept;
  void spend_time(const Task& task);
  void contain_jump() noexcept;
  void contain(FaultKind kind, const char* text) noexcept;
  void conclude(bool ran, const char* threw) noexcept;
  void call_begin_hook() noexcept;
  void call_end_hook(bool faulted) noexcept;
  void account() noexcept;

  RunBlock& block_;
  Kernel& kernel_;
  bool virtual_time_;
  Hooks hooks_;
  CoreTrace& trace_;
  rt::Guard guard_;
  ModuleThread thread_;
  std::atomic<bool> attached_{false};
  // Members, not locals: they must keep their values when a fault jumps back into run().
  std::span<TaskState* const> tasks_;
  std::size_t position_ = 0;
  std::uint64_t tick_ = 0;
  std::int64_t release_ns_ = 0;
  bool hooks_were_slow_ = false;  // the hooks took noticeable time since the clock was read last
  std::vector<RunTimes> times_;
  std::atomic<TaskState*> current_{nullptr};
  std::atomic<std::int64_t> current_start_{0};
  // Time that does not count of a run, and the number of that run.
  std::atomic<std::int64_t> excused_ns_{0};
  std::atomic<std::uint64_t> excused_run_{0};
  std::atomic<std::int32_t> previous_{-1};
  std::atomic<std::int64_t> previous_exec_{0};
};

}  // namespace indurop::scheduler
