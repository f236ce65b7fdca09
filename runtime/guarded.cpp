// SPDX-License-Identifier: Apache-2.0
// Threads of a module: a crash ends the work that one does, not the node.
#include <indurop/guarded.h>

#include <csetjmp>
#include <csignal>

#include "rt/guard_text.h"

namespace irp {

bool guarded(void (*work)(void* with) noexcept, void* with, char* why, std::size_t size) noexcept {
  // The node has handlers of its own, which are called for all other threads.
  static const bool installed = [] {
    struct sigaction now {};
    const bool handled = ::sigaction(SIGSEGV, nullptr, &now) == 0 && (now.sa_flags & SA_SIGINFO) != 0;
    if (handled) {  // else it ends as usual
      indurop::rt::install_guard_handlers();
    }
    return handled;
  }();
  static_cast<void>(installed);
  const indurop::rt::HandlerStack handler_stack;
  const indurop::rt::StackBounds stack = indurop::rt::own_stack();
  indurop::rt::Guard guard;
  guard.enter();
  guard.recovered();  // the thread may have inherited a mask that blocks faults
  if (sigsetjmp(guard.target(), 0) != 0) {
    guard.recovered();
    guard.leave();
    indurop::rt::describe_fault(guard, stack, why, size);
    return false;
  }
  guard.arm();
  work(with);
  guard.disarm();
  guard.leave();
  return true;
}

}  // namespace irp
