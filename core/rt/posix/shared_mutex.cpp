// SPDX-License-Identifier: Apache-2.0
// The shared lock without robust mutexes. A word names the holder, and only a thread that changes it from free to its
// own name gets the lock. A holder that was killed is detected by that name. Waiting with priority inheritance needs a
// mutex, and a mutex whose holder is killed is lost (the C library even aborts those who wait for it). So this mutex,
// the queue, is for the threads of one process only, which all end together: the home of the lock. All other processes
// poll the word.

#include "core/rt/shared_mutex.h"

#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <new>

#include "core/rt/clock.h"

namespace indurop::rt {

namespace {

struct Lock {
  std::atomic<std::uint64_t> word;
  Lock* next;                       // next lock of its holder; used by that thread only
  std::atomic<std::uint64_t> home;  // a process
  pthread_mutex_t queue;            // for threads of the home process
};
static_assert(sizeof(Lock) <= sizeof(SharedMutex));
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

// The word: the holder's process (32 bits), its thread in that process (24), flags (4), a mark (4).
constexpr std::uint64_t kName = (1ULL << 56U) - 1;
constexpr std::uint64_t kProcess = (1ULL << 32U) - 1;
constexpr std::uint64_t kHeld = 1ULL << 56U;
constexpr std::uint64_t kQueued = 2ULL << 56U;  // its holder holds the queue, too
constexpr std::uint64_t kLeft = 4ULL << 56U;    // free: its holder's thread ended with it
constexpr std::uint64_t kFree = 0xAULL << 60U;  // the mark, and no name
constexpr std::uint64_t kMark = 0xFULL << 60U;

constexpr std::int64_t kPauseNs = 50'000;  // polling interval of the word

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): a thread's name, and what it holds
[[gnu::tls_model("initial-exec")]] thread_local std::uint64_t t_name = 0;
[[gnu::tls_model("initial-exec")]] thread_local Lock* t_held = nullptr;
std::atomic<std::uint64_t> threads{0};
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

Lock& in(SharedMutex& mutex) noexcept {
  return *reinterpret_cast<Lock*>(mutex.bytes);
}
std::uint64_t word_of(const SharedMutex& mutex) noexcept {
  return reinterpret_cast<const Lock*>(mutex.bytes)->word.load(std::memory_order_acquire);
}

bool is_sound(std::uint64_t word) noexcept {
  const bool held = (word & kHeld) != 0;
  return (word & kMark) == kFree && held == ((word & kName) != 0) && (held || (word & kQueued) == 0);
}
bool is_of(std::uint64_t word, std::uint64_t name) noexcept {
  return (word & kHeld) != 0 && (word & kName) == name;
}

// A thread ends: its locks become free, but are marked as left.
void leave(void* /*unused*/) noexcept {
  while (Lock* const lock = t_held) {
    t_held = lock->next;
    const std::uint64_t word = lock->word.load(std::memory_order_relaxed);
    if (is_of(word, t_name)) {
      lock->word.store(kFree | kLeft, std::memory_order_release);
      if ((word & kQueued) != 0) {
        ::pthread_mutex_unlock(&lock->queue);
      }
    }
  }
  t_name = 0;
}

// Created at program start at the latest: not at the first lock of a real-time thread.
class EndOfThreads {
 public:
  EndOfThreads() noexcept
      : good_(::pthread_key_create(&key_, leave) == 0 && ::pthread_atfork(nullptr, nullptr, forked) == 0) {}
  [[nodiscard]] bool good() const noexcept { return good_; }
  void watch_this() const noexcept { ::pthread_setspecific(key_, this); }

 private:
  // A child process does not hold its parent's locks.
  static void forked() noexcept {
    t_name = 0;
    t_held = nullptr;
  }
  pthread_key_t key_{};
  bool good_;
};
const EndOfThreads& end_of_threads() noexcept {
  static const EndOfThreads kEnd;  // some variables create locks before other objects of the program exist
  return kEnd;
}
const bool kMade = end_of_threads().good();

std::uint64_t own_name() noexcept {
  if (t_name == 0) {
    end_of_threads().watch_this();
    const std::uint64_t number = threads.fetch_add(1, std::memory_order_relaxed) % (1U << 24U);
    t_name = number << 32U | static_cast<std::uint32_t>(::getpid());
  }
  return t_name;
}

// A child that has ended keeps its number until its parent waits for it.
bool has_ended(std::uint64_t process) noexcept {
  const auto pid = static_cast<pid_t>(process);
  if (pid == static_cast<pid_t>(own_name() & kProcess)) {
    return false;
  }
  if (::kill(pid, 0) != 0) {
    return errno == ESRCH;
  }
  siginfo_t end{};
  return ::waitid(P_PID, static_cast<id_t>(pid), &end, WEXITED | WNOHANG | WNOWAIT) == 0 && end.si_pid == pid;
}

void remember(Lock& lock) noexcept {
  lock.next = t_held;
  t_held = &lock;
}
void forget(const Lock& lock) noexcept {
  for (Lock** at = &t_held; *at != nullptr; at = &(*at)->next) {
    if (*at == &lock) {
      *at = lock.next;
      return;
    }
  }
}

bool is_home(const Lock& lock) noexcept {
  return lock.home.load(std::memory_order_relaxed) == (own_name() & kProcess);
}

// Sets the word if no thread, or only a dead one, holds the lock. A thread that holds the queue of a free lock is about
// to take it or has just released it, and is not overtaken by others of this process (`polite`). `queued`: the caller
// holds it.
LockResult set_word(Lock& lock, bool queued, bool polite) noexcept {
  const std::uint64_t name = own_name();
  std::uint64_t word = lock.word.load(std::memory_order_acquire);
  for (;;) {
    if (!is_sound(word)) {
      return LockResult::Broken;
    }
    const bool held = (word & kHeld) != 0;
    if (held && (word & kName) == name) {
      return LockResult::HeldByCaller;
    }
    if (held ? !has_ended(word & kProcess) : polite && !queued) {
      return LockResult::Timeout;
    }
    const std::uint64_t mine = kFree | kHeld | name | (queued ? kQueued : 0);
    if (lock.word.compare_exchange_weak(word, mine, std::memory_order_acq_rel, std::memory_order_acquire)) {
      remember(lock);
      return held || (word & kLeft) != 0 ? LockResult::OwnerDied : LockResult::Locked;
    }
  }
}

// Mutexes support only the wall clock.
int wait_in_queue(Lock& lock, std::int64_t deadline_ns) noexcept {
  const timespec until = to_timespec(wall_ns() + deadline_ns - now_ns());
  return ::pthread_mutex_timedlock(&lock.queue, &until);
}

LockResult lock_until(Lock& lock, std::int64_t deadline_ns, bool patient) noexcept {
  const bool home = is_home(lock);
  for (;;) {
    LockResult result = set_word(lock, false, home);  // a holder that has ended need not be waited for
    if (result != LockResult::Timeout) {
      return result;
    }
    const int error = home ? wait_in_queue(lock, deadline_ns) : EBUSY;
    const bool queued = error == 0 || error == EDEADLK;  // EDEADLK: a fault ended a run between the two
    const bool over = now_ns() >= deadline_ns;
    result = set_word(lock, queued, home && !(over && patient));
    if (queued && !is_locked(result) && result != LockResult::HeldByCaller) {
      ::pthread_mutex_unlock(&lock.queue);
    }
    if (over || result != LockResult::Timeout) {
      return result;
    }
    sleep_until(std::min(now_ns() + kPauseNs, deadline_ns));
  }
}

bool init_queue(Lock& lock) noexcept {
  pthread_mutexattr_t attributes;
  if (::pthread_mutexattr_init(&attributes) != 0) {
    return false;
  }
  const bool made = ::pthread_mutexattr_setpshared(&attributes, PTHREAD_PROCESS_SHARED) == 0 &&
                    ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT) == 0 &&
                    ::pthread_mutexattr_settype(&attributes, PTHREAD_MUTEX_ERRORCHECK) == 0 &&
                    ::pthread_mutex_init(&lock.queue, &attributes) == 0;
  ::pthread_mutexattr_destroy(&attributes);
  lock.home.store(own_name() & kProcess, std::memory_order_release);
  return made;
}

}  // namespace

const std::uint64_t kLockKind = 0x1'0000'0000U + sizeof(Lock);

ThreadId this_thread() noexcept {
  return ThreadId{own_name()};
}

bool init_shared_mutex(SharedMutex& mutex) noexcept {
  auto* const made = new (mutex.bytes) Lock{};
  made->word.store(kFree, std::memory_order_release);
  return end_of_threads().good() && init_queue(*made);
}

void inherit_shared_mutex(SharedMutex& mutex) noexcept {
  Lock& lock = in(mutex);
  const std::uint64_t word = lock.word.load(std::memory_order_acquire);
  if (is_sound(word) && (word & kQueued) == 0 && has_ended(lock.home.load(std::memory_order_relaxed))) {
    init_queue(lock);
  }
}

bool held_by(const SharedMutex& mutex, ThreadId thread) noexcept {
  return is_of(word_of(mutex), static_cast<std::uint64_t>(thread));
}

int take_free(SharedMutex& mutex) noexcept {
  Lock& lock = in(mutex);
  std::uint64_t word = kFree;
  if (lock.word.load(std::memory_order_relaxed) != word) {
    return EBUSY;
  }
  const bool home = is_home(lock);
  if (home && ::pthread_mutex_trylock(&lock.queue) != 0) {
    return EBUSY;
  }
  const std::uint64_t mine = kFree | kHeld | own_name() | (home ? kQueued : 0);
  if (!lock.word.compare_exchange_strong(word, mine, std::memory_order_acq_rel)) {
    if (home) {
      ::pthread_mutex_unlock(&lock.queue);
    }
    return EBUSY;
  }
  remember(lock);
  return 0;
}

LockResult try_lock(SharedMutex& mutex) noexcept {
  return lock_within(mutex, std::chrono::nanoseconds{0});
}

LockResult lock_refused(SharedMutex& mutex, int /*error*/, std::chrono::nanoseconds limit) noexcept {
  return lock_until(in(mutex), now_ns() + limit.count(), limit.count() > 0);
}

int release(SharedMutex& mutex) noexcept {
  Lock& lock = in(mutex);
  const std::uint64_t word = lock.word.load(std::memory_order_relaxed);
  if (!is_sound(word) || !is_of(word, own_name())) {
    return EPERM;
  }
  forget(lock);
  lock.word.store(kFree, std::memory_order_release);
  if ((word & kQueued) != 0) {
    ::pthread_mutex_unlock(&lock.queue);
  }
  return 0;
}

}  // namespace indurop::rt
