// SPDX-License-Identifier: Apache-2.0
#include "core/rt/fault_handler.h"

#include <utility>

#include "core/rt/guard.h"

namespace indurop::rt {
namespace {

// A signal handler is given nothing else. NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
struct sigaction before[NSIG];
bool replaced[NSIG];
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

void die_of(int number) noexcept {
  struct sigaction standard {};  // a fault cannot be ignored
  standard.sa_handler = SIG_DFL;
  ::sigaction(number, &standard, nullptr);
  ::raise(number);
}

void on_fault(int number, siginfo_t* info, void* context) {
  if (!catch_fault(number, info->si_addr) && !pass_on(number, info, context)) {
    die_of(number);
  }
}

}  // namespace

void install_in_front(int number, SignalHandler handler, int more_flags) noexcept {
  struct sigaction action {};
  action.sa_sigaction = handler;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | more_flags;
  ::sigemptyset(&action.sa_mask);
  struct sigaction old {};
  ::sigaction(number, &action, &old);
  if (!std::exchange(replaced[number], true)) {
    before[number] = old;
  }
}

bool pass_on(int number, siginfo_t* info, void* context) noexcept {
  const struct sigaction& next = before[number];
  if ((next.sa_flags & SA_SIGINFO) != 0 && next.sa_sigaction != nullptr) {
    next.sa_sigaction(number, info, context);
    return true;
  }
  if (next.sa_handler != SIG_DFL && next.sa_handler != SIG_IGN) {
    next.sa_handler(number);
    return true;
  }
  return false;
}

void install_fault_handler(int number) noexcept {
  install_in_front(number, on_fault, SA_NODEFER);
}

}  // namespace indurop::rt
