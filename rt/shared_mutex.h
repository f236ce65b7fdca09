// SPDX-License-Identifier: Apache-2.0
// The lock that processes share: robust (its holder may be killed), priority inheriting (its holder may be preempted)
// and never waited for without limit (its holder may be stopped). Free functions: the mutex lies in shared memory.

#pragma once

#include <pthread.h>
#include <sys/types.h>

#include <chrono>

namespace indurop::rt {

inline constexpr std::chrono::milliseconds kLockLimit{5};

enum class LockResult {
  Locked,
  OwnerDied,     // locked; the previous holder ended while holding it, what it was changing may be half done
  Timeout,       // not free within the limit
  HeldByCaller,  // the calling thread has it already
  Broken,        // not a usable lock: its memory was overwritten, or its owner does not exist
};
constexpr bool is_locked(LockResult result) noexcept {
  return result == LockResult::Locked || result == LockResult::OwnerDied;
}

// Makes a lock of zeroed or other memory nobody uses yet. False if the system has no such locks.
bool init_shared_mutex(pthread_mutex_t& mutex) noexcept;

// What to do about a lock that try-locking refused with `error`: waits if somebody has it.
LockResult lock_refused(pthread_mutex_t& mutex, int error, std::chrono::nanoseconds limit) noexcept;

// Real-time safe: no system call if the lock is free, priority inheritance while waiting.
inline LockResult lock_within(pthread_mutex_t& mutex, std::chrono::nanoseconds limit = kLockLimit) noexcept {
  const int error = ::pthread_mutex_trylock(&mutex);
  return error == 0 ? LockResult::Locked : lock_refused(mutex, error, limit);
}

// Never waits; Timeout if another thread has it.
LockResult try_lock(pthread_mutex_t& mutex) noexcept;

// True if the thread with this kernel id (gettid) has the lock. Real-time safe.
bool held_by(const pthread_mutex_t& mutex, pid_t thread) noexcept;

// False, and nothing happened, if the calling thread does not hold it. Real-time safe.
inline bool unlock(pthread_mutex_t& mutex) noexcept {
  return ::pthread_mutex_unlock(&mutex) == 0;
}

}  // namespace indurop::rt
