// SPDX-License-Identifier: Apache-2.0
#include <indurop/guarded.h>

#include <csetjmp>

#include "rt/guard_text.h"

namespace irp {

bool guarded(void (*work)(void* with) noexcept, void* with, char* why, std::size_t size) noexcept {
  const indurop::rt::HandlerStack handler_stack;
  const indurop::rt::StackBounds stack = indurop::rt::own_stack();
  indurop::rt::Guard guard;
  guard.enter();
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
