// SPDX-License-Identifier: Apache-2.0
// What ended guarded code, in words.

#pragma once

#include <cstddef>

#include "rt/guard.h"
#include "rt/thread.h"

namespace indurop::rt {

// "SIGSEGV (invalid memory access) at address 0x10"; `stack`: of the thread that ran it. The end was no order.
// Real-time safe.
void describe_fault(const Guard& guard, const StackBounds& stack, char* text, std::size_t size) noexcept;

}  // namespace indurop::rt
