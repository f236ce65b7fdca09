// SPDX-License-Identifier: Apache-2.0
// Waits by the monotonic clock.
#include "core/rt/signal_word.h"

#include <semaphore.h>

#include <cerrno>

namespace indurop::rt {

bool SignalWord::wait_until(MonoTime deadline) noexcept {
  const timespec until = to_timespec(to_ns(deadline));
  while (::sem_clockwait(reinterpret_cast<sem_t*>(bytes_), CLOCK_MONOTONIC, &until) != 0) {
    if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace indurop::rt
