// SPDX-License-Identifier: Apache-2.0
#include "core/rt/guard_text.h"

#include <cstdio>

namespace indurop::rt {

namespace {

const char* signal_text(int number) noexcept {
  switch (number) {
    case SIGSEGV:
      return "SIGSEGV (invalid memory access)";
    case SIGBUS:
      return "SIGBUS (access beyond a mapping)";
    case SIGFPE:
      return "SIGFPE (division by zero or overflow)";
    case SIGILL:
      return "SIGILL (illegal instruction)";
    case SIGABRT:
      return "SIGABRT (abort or failed assertion)";
    default:
      return "signal";
  }
}

}  // namespace

void describe_fault(const Guard& guard, const StackBounds& stack, char* text, std::size_t size) noexcept {
  const int number = guard.signal_number();
  if (number == SIGSEGV && stack.overflowed_at(guard.fault_address())) {
    std::snprintf(text, size, "stack overflow: the module's thread has %zu KiB of stack", stack.bytes / 1024);
  } else if (number == SIGSEGV || number == SIGBUS) {
    std::snprintf(text, size, "%s at address %p", signal_text(number), guard.fault_address());
  } else {
    std::snprintf(text, size, "%s", signal_text(number));
  }
}

}  // namespace indurop::rt
