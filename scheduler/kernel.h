// SPDX-License-Identifier: Apache-2.0
// The services the scheduler needs from the system below it: time, waiting, threads. An interface, so that simulation
// and tests can replace the system.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <functional>
#include <memory>

#include "core/rt/clock.h"
#include "core/rt/signal_word.h"
#include "core/rt/thread.h"
#include "scheduler/task.h"

namespace indurop::scheduler {

class Clock {
 public:
  Clock() = default;
  virtual ~Clock() = default;
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;
  virtual rt::MonoTime now() noexcept = 0;                       // never runs backwards
  virtual void sleep_until(rt::MonoTime deadline) noexcept = 0;  // may return late, never early
};

// A thread of a kernel; joined by its destructor.
class KernelThread {
 public:
  KernelThread() = default;
  virtual ~KernelThread() = default;
  KernelThread(const KernelThread&) = delete;
  KernelThread& operator=(const KernelThread&) = delete;
  virtual void join() noexcept = 0;
};

// The default implementations are those of a system with real threads; a simulation overrides them.
class Kernel : public Clock {
 public:
  // Waits for a wake-up by a thread of the same process.
  virtual void wait(rt::SignalWord& word) noexcept;
  // Wakes a process module for the release recorded in its slot, or by its signal.
  virtual void wake_process(const Task& task, ProcessSlot& slot, ModuleRecord& record) noexcept;
  // Returns true if runs take the time of Task::work_ns, by work(): the calling thread works this long.
  [[nodiscard]] virtual bool is_virtual() const noexcept { return false; }
  virtual void work(std::int64_t ns) noexcept;
  // Errors: those of rt::Thread::start().
  virtual Result<std::unique_ptr<KernelThread>> start(const rt::ThreadSettings& settings, std::function<void()> body);
};

// CLOCK_MONOTONIC and POSIX threads.
class SystemKernel final : public Kernel {
 public:
  rt::MonoTime now() noexcept override;
  void sleep_until(rt::MonoTime deadline) noexcept override;
};

}  // namespace indurop::scheduler
