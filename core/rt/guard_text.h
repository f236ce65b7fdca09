// SPDX-License-Identifier: Apache-2.0
// Describes in words what ended guarded code.

#pragma once

#include <cstddef>

#include "core/rt/guard.h"
#include "core/rt/thread.h"

namespace indurop::rt {

// Writes "SIGSEGV (invalid memory access) at address 0x10"; `stack`: of the thread that ran it. Requires that the end
// was not commanded. Real-time safe.
void describe_fault(const Guard& guard, const StackBounds& stack, char* text, std::size_t size) noexcept;

}  // namespace indurop::rt
