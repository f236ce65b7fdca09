// SPDX-License-Identifier: Apache-2.0
// For threads that a module starts by itself: a crash there ends what the thread does, not the node.

#pragma once

#include <cstddef>

namespace irp {

// Calls work(with) on the calling thread, which is one of the module's own. False: it crashed (SIGSEGV, SIGBUS, SIGFPE,
// SIGILL, abort), and `why` says how. Its destructors did not run, and locks that it held stay held: the module should
// bring what it drives to rest and end, for example by an exception in run(). Outside a node the process ends as usual.
// Not real-time safe.
bool guarded(void (*work)(void* with) noexcept, void* with, char* why, std::size_t size) noexcept;

}  // namespace irp
