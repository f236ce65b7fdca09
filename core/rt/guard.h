// SPDX-License-Identifier: Apache-2.0
// Runs code that may crash or never return, and recovers the thread: SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT and a
// command from a watchdog end the guarded code by a jump, not the process. Destructors of the guarded code do not run;
// locks of the C library that it held stay held. Containment, not repair: the code must not be entered again.

#pragma once

#include <pthread.h>
#include <csetjmp>

#include <atomic>
#include <csignal>
#include <cstdint>

namespace indurop::rt {

// Installs the handlers, once per process. Not real-time safe.
void install_guard_handlers() noexcept;

// The first step of the handlers: replaces a lost page (core/rt/lost_pages.h) or jumps to the calling thread's guard if
// it is armed. If it returns: whether the thread can continue. Real-time safe.
bool catch_fault(int number, void* address) noexcept;
// A library of the program has its own copy of this code, with its own guards and mappings: the handlers call its
// catch_fault() after their own. Null: there is none.
using CatchFault = bool (*)(int number, void* address) noexcept;
void catch_faults_also_by(CatchFault library) noexcept;

// Gives the calling thread a separate stack for signal handlers, so that even a stack overflow is survived; freed with
// it.
class HandlerStack {
 public:
  HandlerStack() noexcept;
  ~HandlerStack();
  HandlerStack(const HandlerStack&) = delete;
  HandlerStack& operator=(const HandlerStack&) = delete;

 private:
  void* memory_ = nullptr;
};

// State of one thread that runs guarded code. Used through this pattern, which keeps the jump inside one function:
//   guard.enter();  if (sigsetjmp(guard.target(), 0) != 0) { ... guard.signal_number() ... }  guard.arm(); f();
//   guard.disarm();
class Guard {
 public:
  // Makes this the calling thread's guard.
  void enter() noexcept;
  void leave() noexcept;
  // For a thread that runs several fibers: replaces the current guard and returns the previous one.
  static Guard* exchange_current(Guard* guard) noexcept;
  sigjmp_buf& target() noexcept { return target_; }

  // Between arm and disarm a fault jumps to target(). Real-time safe, no system call.
  void arm() noexcept {
    run_.store(run_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);  // no other thread writes it
    armed_.store(true, std::memory_order_release);
  }
  void disarm() noexcept { armed_.store(false, std::memory_order_release); }
  // After a jump: unblocks the signal that caused it.
  void recovered() noexcept;

  [[nodiscard]] int signal_number() const noexcept { return signal_; }
  [[nodiscard]] const void* fault_address() const noexcept { return address_; }
  static constexpr int kOrder = 0;  // signal_number() if the watchdog commanded the end

  // From another thread: ends the guarded run `run` of `thread` if it is still in progress.
  [[nodiscard]] std::uint64_t current_run() const noexcept { return run_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool armed() const noexcept { return armed_.load(std::memory_order_acquire); }
  void order_end(pthread_t thread, std::uint64_t run) noexcept;

  // For the handlers only.
  void on_signal(int number, void* address) noexcept;

 private:
  sigjmp_buf target_{};
  std::atomic<bool> armed_{false};
  std::atomic<std::uint64_t> run_{0};
  std::atomic<std::uint64_t> ordered_run_{0};
  int signal_ = 0;
  void* address_ = nullptr;
};

}  // namespace indurop::rt
