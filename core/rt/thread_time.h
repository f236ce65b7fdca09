// SPDX-License-Identifier: Apache-2.0
// The processor time that the calling thread has used.

#pragma once

#include <ctime>

#include <cstdint>

#include "core/rt/clock.h"

namespace indurop::rt {

inline std::int64_t thread_time_ns() noexcept {
  timespec used{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return used.tv_sec * kNanosPerSecond + used.tv_nsec;
}

}  // namespace indurop::rt
