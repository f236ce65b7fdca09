// SPDX-License-Identifier: Apache-2.0
#include "rt/signal_word.h"

#include <cerrno>

namespace indurop::rt {

void SignalWord::init(bool process_shared) noexcept {
  ::sem_init(&semaphore_, process_shared ? 1 : 0, 0);
}

void SignalWord::wake() noexcept {
  ::sem_post(&semaphore_);
}

bool SignalWord::wait_until(MonoTime deadline) noexcept {
  const timespec until = to_timespec(to_ns(deadline));
  while (::sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until) != 0) {
    if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

void SignalWord::wait() noexcept {
  while (::sem_wait(&semaphore_) != 0 && errno == EINTR) {
  }
}

bool SignalWord::try_wait() noexcept {
  return ::sem_trywait(&semaphore_) == 0;
}

}  // namespace indurop::rt
