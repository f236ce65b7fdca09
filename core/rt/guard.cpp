// SPDX-License-Identifier: Apache-2.0
#include "core/rt/guard.h"

#include <atomic>
#include <csetjmp>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>

#include "core/rt/fault_handler.h"
#include "core/rt/lost_pages.h"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>

#include "core/rt/fiber.h"
#endif

namespace indurop::rt {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler is given nothing else
thread_local Guard* t_guard = nullptr;

constexpr int kFaultSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
int order_signal() noexcept {
  return SIGRTMIN + 1;
}

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): likewise
std::atomic<CatchFault> g_library{nullptr};

void on_order(int number, siginfo_t* info, void* context) {
  (void)catch_fault(Guard::kOrder, nullptr);
  (void)pass_on(number, info, context);
}

constexpr std::size_t kHandlerStackBytes = std::size_t{64} * 1024;

}  // namespace

void install_guard_handlers() noexcept {
  for (const int number : kFaultSignals) {
    install_fault_handler(number);
  }
  // Commands queue up while their thread gets no processor. Without SA_NODEFER they are delivered one after the other;
  // all at once their frames would overflow the handler's stack.
  install_in_front(order_signal(), on_order, 0);
}

bool catch_fault(int number, void* address) noexcept {
  const bool survived = number == SIGBUS && replace_lost_page(address);
  // A module must not continue with zeros instead of its values.
  if (t_guard != nullptr && t_guard->armed()) {
    t_guard->on_signal(number, address);
  }
  const CatchFault library = g_library.load(std::memory_order_acquire);
  const bool survived_there = library != nullptr && number != Guard::kOrder && library(number, address);
  return survived || survived_there;
}

void catch_faults_also_by(CatchFault library) noexcept {
  g_library.store(library, std::memory_order_release);
}

HandlerStack::HandlerStack() noexcept : memory_(std::malloc(kHandlerStackBytes)) {  // NOLINT: freed in the destructor
  if (memory_ != nullptr) {
    stack_t stack{};
    stack.ss_sp = memory_;
    stack.ss_size = kHandlerStackBytes;
    ::sigaltstack(&stack, nullptr);
  }
}

HandlerStack::~HandlerStack() {
  stack_t none{};
  none.ss_flags = SS_DISABLE;
  ::sigaltstack(&none, nullptr);
  std::free(memory_);  // NOLINT
}

void Guard::enter() noexcept {
  t_guard = this;
}
void Guard::leave() noexcept {  // NOLINT(readability-convert-member-functions-to-static): the other half of enter()
  t_guard = nullptr;
}

Guard* Guard::exchange_current(Guard* guard) noexcept {
  return std::exchange(t_guard, guard);
}

void Guard::recovered() noexcept {  // NOLINT(readability-convert-member-functions-to-static): said of this guard
  sigset_t set;
  ::sigemptyset(&set);
  for (const int number : kFaultSignals) {
    ::sigaddset(&set, number);
  }
  ::sigaddset(&set, order_signal());
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

void Guard::order_end(pthread_t thread, std::uint64_t run) noexcept {
  ordered_run_.store(run, std::memory_order_release);
  ::pthread_kill(thread, order_signal());
}

void Guard::on_signal(int number, void* address) noexcept {
  if (number == kOrder && ordered_run_.load(std::memory_order_acquire) != current_run()) {
    return;  // too late: that run has ended normally
  }
  armed_.store(false, std::memory_order_release);
  signal_ = number;
  address_ = address;
#if defined(__SANITIZE_ADDRESS__)
  // It forgets what is left of frames on the thread's stack when a handler jumps, but not on a fiber's.
  if (const Fiber* const fiber = Fiber::current()) {
    __asan_unpoison_memory_region(fiber->stack().lowest, fiber->stack().bytes);
  }
#endif
  ::siglongjmp(target_, 1);
}

}  // namespace indurop::rt
