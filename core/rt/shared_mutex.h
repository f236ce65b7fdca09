// SPDX-License-Identifier: Apache-2.0
// A lock shared by processes: it outlives its holder (who may be killed), inherits priority (its holder may be
// preempted) and every wait has a limit (its holder may be stopped). Free functions, because it is in shared memory.

#pragma once

#include <indurop/detail/shared_mutex.h>

#include <chrono>
#include <cstdint>

namespace indurop::rt {

using abi::SharedMutex;

inline constexpr std::chrono::milliseconds kLockLimit{5};

enum class LockResult {
  Locked,
  OwnerDied,     // locked; the previous holder ended while holding it, its change may be half done
  Timeout,       // not free within the limit
  HeldByCaller,  // the calling thread already holds it
  Broken,        // not a usable lock: its memory was overwritten, or its owner does not exist
};
constexpr bool is_locked(LockResult result) noexcept {
  return result == LockResult::Locked || result == LockResult::OwnerDied;
}

// A thread, unique on the machine.
enum class ThreadId : std::uint64_t {};
ThreadId this_thread() noexcept;

// Two programs can share a lock only if this number, which identifies the lock's memory format, is the same in both.
extern const std::uint64_t kLockKind;

// Creates a lock in memory that is not in use yet, zeroed or not. Returns false if the system has no such locks.
bool init_shared_mutex(SharedMutex& mutex) noexcept;

// For a lock in memory whose creator may have ended: transfers to the calling process what the creator held of it. No
// other process may do this at the same time. Not real-time safe.
void inherit_shared_mutex(SharedMutex& mutex) noexcept;

// Takes the lock if that needs neither waiting nor checking. Returns 0 if locked; else the error to pass to
// lock_refused().
int take_free(SharedMutex& mutex) noexcept;
// Handles the `error` of take_free(): waits if another thread holds the lock.
LockResult lock_refused(SharedMutex& mutex, int error, std::chrono::nanoseconds limit) noexcept;

// Real-time safe: no system call if the lock is free, priority inheritance while waiting (core/rt/posix/: among the
// threads of the process that made the lock).
inline LockResult lock_within(SharedMutex& mutex, std::chrono::nanoseconds limit = kLockLimit) noexcept {
  const int error = take_free(mutex);
  return error == 0 ? LockResult::Locked : lock_refused(mutex, error, limit);
}

// Never waits; returns Timeout if another thread holds it.
LockResult try_lock(SharedMutex& mutex) noexcept;

// Real-time safe.
bool held_by(const SharedMutex& mutex, ThreadId thread) noexcept;

// Returns 0; or an error if it cannot be released: the calling thread does not hold it.
int release(SharedMutex& mutex) noexcept;
// Returns false, without effect, if the calling thread does not hold it. Real-time safe.
inline bool unlock(SharedMutex& mutex) noexcept {
  return release(mutex) == 0;
}

}  // namespace indurop::rt
