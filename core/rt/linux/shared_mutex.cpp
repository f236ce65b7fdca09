// SPDX-License-Identifier: Apache-2.0
// The C library's robust mutex with priority inheritance: the kernel reports to the next holder that the previous one
// died.

#include "core/rt/shared_mutex.h"

#include <pthread.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <new>

#include "core/rt/clock.h"

namespace indurop::rt {

const std::uint64_t kLockKind = sizeof(pthread_mutex_t);

namespace {

static_assert(sizeof(pthread_mutex_t) <= sizeof(SharedMutex));

pthread_mutex_t& in(SharedMutex& mutex) noexcept {
  return *reinterpret_cast<pthread_mutex_t*>(mutex.bytes);  // NOLINT(misc-non-copyable-objects): never copied
}

// The kernel's part of a robust priority-inheriting mutex is its first word: bits 0..29 are the owner's thread id.
constexpr std::uint32_t kOwnerMask = 0x3FFFFFFF;
constexpr std::uint32_t kOwnerDiedBit = 0x40000000;

std::uint32_t lock_word(const SharedMutex& mutex) noexcept {
  return __atomic_load_n(reinterpret_cast<const std::uint32_t*>(mutex.bytes), __ATOMIC_ACQUIRE);
}

// Returns true if the word names a thread that does not exist. The C library aborts the process when the kernel reports
// that.
bool has_impossible_owner(const SharedMutex& mutex) noexcept {
  const std::uint32_t before = lock_word(mutex);
  const std::uint32_t owner = before & kOwnerMask;
  if (owner == 0 || (before & kOwnerDiedBit) != 0) {
    return false;
  }
  if (::syscall(SYS_tkill, static_cast<pid_t>(owner), 0) == 0 || errno != ESRCH) {
    return false;
  }
  return lock_word(mutex) == before;  // a thread that just ended has released it by now
}

LockResult translate(pthread_mutex_t& mutex, int error) noexcept {
  switch (error) {
    case 0:
      return LockResult::Locked;
    case EOWNERDEAD:
      ::pthread_mutex_consistent(&mutex);
      return LockResult::OwnerDied;
    case EBUSY:
    case ETIMEDOUT:
      return LockResult::Timeout;
    case EDEADLK:
      return LockResult::HeldByCaller;
    default:
      return LockResult::Broken;
  }
}

int lock_until(pthread_mutex_t& mutex, std::int64_t deadline_ns) noexcept {
#ifdef __SANITIZE_THREAD__  // it knows try-locking, but not the timed lock on the monotonic clock
  int error = EBUSY;
  while (error == EBUSY && now_ns() < deadline_ns) {
    ::sched_yield();
    error = ::pthread_mutex_trylock(&mutex);
  }
  return error;
#else
  const timespec deadline = to_timespec(deadline_ns);
  return ::pthread_mutex_clocklock(&mutex, CLOCK_MONOTONIC, &deadline);
#endif
}

}  // namespace

ThreadId this_thread() noexcept {
  return ThreadId{static_cast<std::uint32_t>(::gettid())};
}

bool init_shared_mutex(SharedMutex& mutex) noexcept {
  pthread_mutexattr_t attributes;
  if (::pthread_mutexattr_init(&attributes) != 0) {
    return false;
  }
  auto* const made = new (mutex.bytes) pthread_mutex_t;
  const bool good = ::pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED) == 0 &&
                    ::pthread_mutexattr_setrobust(&attributes, PTHREAD_MUTEX_ROBUST) == 0 &&
                    ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT) == 0 &&
                    ::pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_ERRORCHECK) == 0 &&
                    ::pthread_mutex_init(made, &attributes) == 0;
  ::pthread_mutexattr_destroy(&attributes);
  return good;
}

void inherit_shared_mutex(SharedMutex& /*mutex*/) noexcept {}  // the kernel does not distinguish between processes

bool held_by(const SharedMutex& mutex, ThreadId thread) noexcept {
  return (lock_word(mutex) & kOwnerMask) == static_cast<std::uint64_t>(thread);
}

int take_free(SharedMutex& mutex) noexcept {
  return ::pthread_mutex_trylock(&in(mutex));
}

LockResult try_lock(SharedMutex& mutex) noexcept {
  return translate(in(mutex), take_free(mutex));
}

LockResult lock_refused(SharedMutex& mutex, int error, std::chrono::nanoseconds limit) noexcept {
  if (error != EBUSY) {
    return translate(in(mutex), error);
  }
  if (has_impossible_owner(mutex)) {
    return LockResult::Broken;
  }
  return translate(in(mutex), lock_until(in(mutex), now_ns() + limit.count()));
}

int release(SharedMutex& mutex) noexcept {
  return ::pthread_mutex_unlock(&in(mutex));
}

}  // namespace indurop::rt
