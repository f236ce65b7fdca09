// SPDX-License-Identifier: Apache-2.0
#include "rt/guard.h"

#include <cstdlib>
#include <utility>

#include "rt/lost_pages.h"

namespace indurop::rt {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a signal handler is given nothing else
thread_local Guard* t_guard = nullptr;

constexpr int kFaultSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
int order_signal() noexcept {
  return SIGRTMIN + 1;
}

// The handlers that ours replaced first, by their signal: a library has its own copy of this code, and its handlers
// come after the node's. Handlers that are installed again keep what they knew, so two copies never call each other in
// turn. NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): likewise
struct sigaction before[NSIG];
bool replaced[NSIG];
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

// False: there is none. One that returns has dealt with the signal.
bool call_before(int number, siginfo_t* info, void* context) {
  if (before[number].sa_sigaction == nullptr) {
    return false;
  }
  before[number].sa_sigaction(number, info, context);
  return true;
}

void on_fault(int number, siginfo_t* info, void* context) {
  const bool survived = number == SIGBUS && replace_lost_page(info->si_addr);
  // A module does not go on with zeros in place of its values.
  if (t_guard != nullptr && t_guard->armed()) {
    t_guard->on_signal(number, info->si_addr);
  }
  if (survived || call_before(number, info, context)) {
    return;
  }
  // Our own fault or a thread we do not guard: die as usual, with a core dump.
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  ::sigaction(number, &standard, nullptr);
  ::raise(number);
}

void on_order(int number, siginfo_t* info, void* context) {
  if (t_guard != nullptr && t_guard->armed()) {
    t_guard->on_signal(Guard::kOrder, nullptr);
  }
  (void)call_before(number, info, context);
}

void install(int number, void (*handler)(int, siginfo_t*, void*), int more_flags) noexcept {
  struct sigaction action {};
  action.sa_sigaction = handler;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | more_flags;
  ::sigemptyset(&action.sa_mask);
  struct sigaction old {};
  ::sigaction(number, &action, &old);
  if (!std::exchange(replaced[number], true) && (old.sa_flags & SA_SIGINFO) != 0 && old.sa_sigaction != handler) {
    before[number] = old;
  }
}

constexpr std::size_t kHandlerStackBytes = std::size_t{64} * 1024;

}  // namespace

void install_guard_handlers() noexcept {
  for (const int number : kFaultSignals) {
    install(number, on_fault, SA_NODEFER);
  }
  // Orders queue up while their thread gets no processor. Without SA_NODEFER they are delivered one after the other;
  // all at once their frames would overflow the handler's stack.
  install(order_signal(), on_order, 0);
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
    return;  // too late: that run has ended by itself
  }
  armed_.store(false, std::memory_order_release);
  signal_ = number;
  address_ = address;
  ::siglongjmp(target_, 1);
}

}  // namespace indurop::rt
