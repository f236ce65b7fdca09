// SPDX-License-Identifier: Apache-2.0
// A kernel in virtual time: threads are fibers of one thread, dispatched by fixed priority on simulated cores, as a
// real-time system with SCHED_FIFO would. Code takes no time, except for the time given to work(); time passes only
// while no thread has anything to do. The same threads, started in the same order, run in the same order at the same
// times.
// While a process module runs, time stands still. The work of a thread is preempted where a real one would be; its
// code, which has run at the begin of that work, is not.
// has run at the begin of that work, is not.

#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "core/rt/fiber.h"
#include "scheduler/kernel.h"

namespace indurop::scheduler {

// Callbacks of the simulation while it waits for a process, which runs in real time.
struct ProcessWatch {
  // Called repeatedly; false: stop waiting for this module, which has run for `so_long` in real time.
  std::function<bool(const ModuleRecord&, std::chrono::nanoseconds so_long)> patient;
  // Returns true if the process has handled the signal it was sent.
  std::function<bool(pid_t, int signal)> at_rest;
};

class SimulatedKernel final : public Kernel {
 public:
  // Time begins at `begin` and is written, in nanoseconds, to each location in `shown` for those who share that memory.
  SimulatedKernel(rt::MonoTime begin, std::vector<std::atomic<std::int64_t>*> shown, ProcessWatch watch);
  ~SimulatedKernel() override;

  rt::MonoTime now() noexcept override { return rt::mono_time(now_ns_.load(std::memory_order_relaxed)); }
  // From outside all threads: lets time pass until `deadline`.
  void sleep_until(rt::MonoTime deadline) noexcept override;
  void wait(rt::SignalWord& word) noexcept override;
  // From inside a thread. Returns false if the time passed without a wake-up.
  bool wait_until(rt::SignalWord& word, rt::MonoTime deadline) noexcept;
  void wake_process(const Task& task, ProcessSlot& slot, ModuleRecord& record) noexcept override;
  [[nodiscard]] bool is_virtual() const noexcept override { return true; }
  void work(std::int64_t ns) noexcept override;
  // Errors: NoSpace.
  Result<std::unique_ptr<KernelThread>> start(const rt::ThreadSettings& settings, std::function<void()> body) override;

  // The time of the next event that needs no input from outside; kNever: there is none.
  [[nodiscard]] rt::MonoTime next_event() const noexcept;
  // Changes whenever a thread resumes. Any thread of the system.
  [[nodiscard]] std::uint64_t resumptions() const noexcept { return resumptions_.load(std::memory_order_relaxed); }
  static constexpr rt::MonoTime kNever = rt::mono_time(INT64_MAX);

 private:
  struct Thread;
  struct Process;
  class Handle;
  Thread* start_thread(const rt::ThreadSettings& settings, std::function<void()> body);
  Process& process_of(const Task& task, ProcessSlot& slot, ModuleRecord& record);
  void run_process(Process& process) noexcept;
  void run_signalled(Process& process) noexcept;
  void run_until_quiet() noexcept;
  void run(Thread& thread) noexcept;
  void take_wake_ups() noexcept;
  [[nodiscard]] Thread* next_to_run() const noexcept;
  [[nodiscard]] const Thread* top_of(int core) const noexcept;
  void pass_time(rt::MonoTime until) noexcept;
  [[nodiscard]] bool at_work(const Thread& thread) const noexcept;
  void set_time(std::int64_t ns) noexcept;
  void join(Thread& thread) noexcept;

  std::atomic<std::int64_t> now_ns_;
  std::vector<std::atomic<std::int64_t>*> shown_;
  ProcessWatch watch_;
  std::vector<std::unique_ptr<Thread>> threads_;
  std::vector<Thread*> working_;  // used by pass_time()
  std::vector<int> cores_;        // in the order of their first thread
  std::map<const ProcessSlot*, std::unique_ptr<Process>> processes_;
  std::uint64_t became_ready_ = 0;
  Thread* running_ = nullptr;
  std::atomic<std::uint64_t> resumptions_{0};
};

}  // namespace indurop::scheduler
