// SPDX-License-Identifier: Apache-2.0
// The processor time that a thread or a process has used.

#pragma once

#include <sys/types.h>

#include <ctime>

#include <cstdint>

#include "core/rt/clock.h"

namespace indurop::rt {

// Of the calling thread.
inline std::int64_t thread_time_ns() noexcept {
  timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return used.tv_sec * kNanosPerSecond + used.tv_nsec;
}

// Of all threads of a process; 0: it does not exist any more.
inline std::int64_t process_time_ns(pid_t pid) noexcept {
  timespec used{};
  clockid_t clock{};
  if (::clock_getcpuclockid(pid, &clock) != 0 || ::clock_gettime(clock, &used) != 0) {
    return 0;
  }
  return used.tv_sec * kNanosPerSecond + used.tv_nsec;
}

}  // namespace indurop::rt
