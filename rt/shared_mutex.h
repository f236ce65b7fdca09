// SPDX-License-Identifier: Apache-2.0
// The lock that processes share: it outlives its holder (who may be killed), inherits priority (its holder may be
// preempted) and is never waited for without limit (its holder may be stopped). Free functions: it lies in shared
// memory.

#pragma once

#include <indurop/detail/shared_mutex.h>

#include <chrono>
#include <cstdint>

namespace indurop::rt {

using abi::SharedMutex;

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

// A thread, among all of the machine.
enum class ThreadId : std::uint64_t {};
ThreadId this_thread() noexcept;

// Two programs can share a lock only if this number is the same in both: what the bytes of a lock mean.
extern const std::uint64_t kLockKind;

// Makes a lock of zeroed or other memory nobody uses yet. False if the system has no such locks.
bool init_shared_mutex(SharedMutex& mutex) noexcept;

// Of a lock in memory whose maker may have ended: what the maker had from it, the calling process has now. Nobody else
// does this at the same time. Not real-time safe.
void inherit_shared_mutex(SharedMutex& mutex) noexcept;

// Takes it if that needs no waiting and no looking. 0: locked; else what lock_refused() has to be told.
int take_free(SharedMutex& mutex) noexcept;
// What to do about a lock that take_free() refused with `error`: waits if somebody has it.
LockResult lock_refused(SharedMutex& mutex, int error, std::chrono::nanoseconds limit) noexcept;

// Real-time safe: no system call if the lock is free, priority inheritance while waiting (rt/posix/: among the threads
// of the process that made the lock).
inline LockResult lock_within(SharedMutex& mutex, std::chrono::nanoseconds limit = kLockLimit) noexcept {
  const int error = take_free(mutex);
  return error == 0 ? LockResult::Locked : lock_refused(mutex, error, limit);
}

// Never waits; Timeout if another thread has it.
LockResult try_lock(SharedMutex& mutex) noexcept;

// Real-time safe.
bool held_by(const SharedMutex& mutex, ThreadId thread) noexcept;

// 0; or what keeps it from being let go: the calling thread does not hold it.
int let_go(SharedMutex& mutex) noexcept;
// False, and nothing happened, if the calling thread does not hold it. Real-time safe.
inline bool unlock(SharedMutex& mutex) noexcept {
  return let_go(mutex) == 0;
}

}  // namespace indurop::rt
