// SPDX-License-Identifier: Apache-2.0
// Threads of a module: a crash ends the work of that thread, not the node.
#include <indurop/crash_guard.h>

#include <csetjmp>
#include <cstddef>

#include "core/rt/guard.h"
#include "core/rt/guard_text.h"
#include "core/rt/thread.h"
#include "store/runtime/host.h"

namespace indurop::runtime {

bool catch_fault(int number, void* address) noexcept {
  return rt::catch_fault(number, address);
}

}  // namespace indurop::runtime

namespace irp {

bool guarded(void (*work)(void* with) noexcept, void* with, char* why, std::size_t size) noexcept {
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
