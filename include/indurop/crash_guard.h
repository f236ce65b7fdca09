// SPDX-License-Identifier: Apache-2.0
// For threads that a module starts itself: a crash there ends the work of that thread, not the node.

#pragma once

#include <cstddef>

namespace irp {

// Calls work(with) on the calling thread, which is one of the module's own. Returns false if it crashed (SIGSEGV,
// SIGBUS, SIGFPE, SIGILL, abort); `why` then describes the crash. Destructors of the work did not run, and locks that
// it held stay held: the module should stop what it drives and end, for example by an exception in run(). Outside a
// node the process ends as usual. Not real-time safe.
bool guarded(void (*work)(void* with) noexcept, void* with, char* why, std::size_t size) noexcept;

}  // namespace irp
