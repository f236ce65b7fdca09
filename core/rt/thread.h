// SPDX-License-Identifier: Apache-2.0
// Threads with a real-time priority and a core, and what the operating system actually granted.

#pragma once

#include <indurop/result.h>
#include <pthread.h>
#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace indurop::rt {

// Returns the cores this process may use, ascending. Not real-time safe.
std::vector<int> allowed_cores();

// Sets the priority of the calling thread under SCHED_FIFO; 0 returns it to normal scheduling. Errors:
// PermissionDenied.
Status set_fifo(int priority) noexcept;
// The same for another process (its main thread). Errors: PermissionDenied, NotFound.
Status set_fifo_of(pid_t process, int priority) noexcept;
// Returns the FIFO priority of the calling thread, 0 if it has none.
int fifo_priority() noexcept;

// Binds the calling thread, and those it will start, to one core or to a set of cores. Errors: InvalidArgument (no such
// core, or an empty set).
Status pin_to_core(int core) noexcept;
Status pin_to_cores(const std::vector<int>& cores) noexcept;
Status pin_process_to_core(pid_t process, int core) noexcept;

// The calling thread's stack. Querying it is not real-time safe.
struct StackBounds {
  const char* lowest = nullptr;
  std::size_t bytes = 0;
  // Returns true if an access to this address means a stack overflow: just below the stack, where the guard pages are.
  [[nodiscard]] bool overflowed_at(const void* address) const noexcept;
};
StackBounds own_stack() noexcept;

// Sleeps of a thread without real-time priority end up to 50 us late by default; asks for 1 ns.
void request_exact_timers() noexcept;

struct ThreadSettings {
  std::string name;                                   // the system shows at most 15 characters
  int fifo_priority = 0;                              // 0: normal scheduling
  int core = -1;                                      // -1: not pinned
  std::size_t stack_bytes = std::size_t{512} * 1024;  // whole pages, in addition to thread-local variables
  bool runs_modules = false;                          // has a HandlerStack (core/rt/guard.h)
};

// Memory for a thread's stack. Not taken from the C library, which caches the stacks of ended threads; locked memory
// would then hold them permanently.
class Stack {
 public:
  Stack() = default;
  Stack(std::size_t bytes, bool touched) noexcept;
  Stack(Stack&& other) noexcept;
  Stack& operator=(Stack&& other) noexcept;
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;
  ~Stack();
  [[nodiscard]] bool ok() const noexcept { return memory_ != nullptr; }
  [[nodiscard]] std::uint8_t* lowest() const noexcept;

 private:
  std::uint8_t* memory_ = nullptr;  // including the guard page
  std::size_t bytes_ = 0;
};

// A thread that starts with its settings applied and, if it has a priority, its stack already touched. Its destructor
// joins it.
class Thread {
 public:
  Thread() = default;
  // Calls `body` after trying the settings; a rejected priority does not prevent it from running (check
  // fifo_priority()). Not real-time safe. Errors: System, NoSpace.
  static Result<Thread> start(const ThreadSettings& settings, std::function<void()> body);
  Thread(Thread&& other) noexcept;
  Thread& operator=(Thread&& other) noexcept;
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;
  ~Thread();

  void join() noexcept;
  [[nodiscard]] bool joinable() const noexcept { return running_; }
  [[nodiscard]] pthread_t handle() const noexcept { return handle_; }

 private:
  Stack stack_;  // released once the thread has ended
  pthread_t handle_{};
  bool running_ = false;
};

}  // namespace indurop::rt
