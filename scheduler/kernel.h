// SPDX-License-Identifier: Apache-2.0
// What the scheduler asks of the system below it: time, waiting, threads. An interface, so that simulation and tests
// can be that system.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <functional>
#include <memory>

#include "rt/clock.h"
#include "rt/signal_word.h"
#include "rt/thread.h"
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

// Here what a system with real threads does; a simulation does otherwise.
class Kernel : public Clock {
 public:
  // Waits for a wake-up that a thread of the same process gives.
  virtual void wait(rt::SignalWord& word) noexcept;
  // Wakes a process module for the release that its slot tells of, or by its signal.
  virtual void wake_process(const Task& task, ProcessSlot& slot, ModuleRecord& record) noexcept;
  // Runs take the time that Task::work_ns says, by work(): the calling thread works this long.
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
