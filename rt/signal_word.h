// SPDX-License-Identifier: Apache-2.0
// A wake-up that threads and processes sleep on: a semaphore in shared memory. Measured as fast as a bare futex here,
// and every POSIX real-time system has it. Zero-filled memory must be initialised before use.

#pragma once

#include "rt/clock.h"

namespace indurop::rt {

class SignalWord {
 public:
  // Not real-time safe. Once, by the creator of the memory.
  void init(bool process_shared) noexcept;
  // Real-time safe; no system call if nobody sleeps.
  void wake() noexcept;
  // Sleeps until woken. False if the deadline passed first; a signal does not end the wait.
  bool wait_until(MonoTime deadline) noexcept;
  void wait() noexcept;
  bool try_wait() noexcept;

 private:
  alignas(8) unsigned char bytes_[32];  // what the system keeps there
};

}  // namespace indurop::rt
