// SPDX-License-Identifier: Apache-2.0
// Hints to the processor that this is a wait loop: saves power and lets the other hardware thread of a core run.
// Real-time safe.

#pragma once

namespace indurop::rt {

inline void relax() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

}  // namespace indurop::rt
