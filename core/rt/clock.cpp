// SPDX-License-Identifier: Apache-2.0
#include "core/rt/clock.h"

#include <cerrno>

namespace indurop::rt {

void sleep_until(std::int64_t deadline_ns) noexcept {
  const timespec deadline = to_timespec(deadline_ns);
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace indurop::rt
