// SPDX-License-Identifier: Apache-2.0
// Semaphores support only the wall clock. If it is set forward the wait is resumed; if it is set back during a wait, a
// wait without a wake-up ends that much later.
#include "core/rt/signal_word.h"

#include <semaphore.h>

#include <algorithm>
#include <cerrno>

namespace indurop::rt {

bool SignalWord::wait_until(MonoTime deadline) noexcept {
  for (;;) {
    const std::int64_t left = std::max<std::int64_t>(to_ns(deadline) - now_ns(), 0);
    const timespec until = to_timespec(wall_ns() + left);
    if (::sem_timedwait(reinterpret_cast<sem_t*>(bytes_), &until) == 0) {
      return true;
    }
    if (errno != EINTR && left == 0) {
      return false;
    }
  }
}

}  // namespace indurop::rt
