// SPDX-License-Identifier: Apache-2.0
// A wake-up for sleeping threads and processes: a semaphore in shared memory. Measured as fast as a bare futex for this
// use, and every POSIX real-time system has it. Zero-filled memory must be initialised before use.

#pragma once

#include "core/rt/clock.h"

namespace indurop::rt {

class SignalWord {
 public:
  // Not real-time safe. Called once, by the creator of the memory.
  void init(bool process_shared) noexcept;
  // Real-time safe; no system call if no thread sleeps.
  void wake() noexcept;
  // Sleeps until woken. Returns false if the deadline passed first; a signal does not end the wait.
  bool wait_until(MonoTime deadline) noexcept;
  void wait() noexcept;
  bool try_wait() noexcept;

 private:
  alignas(8) unsigned char bytes_[32];  // the semaphore of the system
};

}  // namespace indurop::rt
