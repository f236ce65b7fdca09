// SPDX-License-Identifier: Apache-2.0
// Waiting with a deadline depends on the system: see linux/ and posix/.
#include "core/rt/signal_word.h"

#include <semaphore.h>

#include <cerrno>
#include <new>

namespace indurop::rt {

static_assert(sizeof(sem_t) <= sizeof(SignalWord));

void SignalWord::init(bool process_shared) noexcept {
  ::sem_init(new (bytes_) sem_t, process_shared ? 1 : 0, 0);
}

void SignalWord::wake() noexcept {
  ::sem_post(reinterpret_cast<sem_t*>(bytes_));
}

void SignalWord::wait() noexcept {
  while (::sem_wait(reinterpret_cast<sem_t*>(bytes_)) != 0 && errno == EINTR) {
  }
}

bool SignalWord::try_wait() noexcept {
  return ::sem_trywait(reinterpret_cast<sem_t*>(bytes_)) == 0;
}

}  // namespace indurop::rt
