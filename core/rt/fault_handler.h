// SPDX-License-Identifier: Apache-2.0
// The handlers of this process for fault signals. They are called before those that were installed earlier, such as a
// user's or those of another copy of this code, which a library has for itself.

#pragma once

#include <csignal>

namespace indurop::rt {

using SignalHandler = void (*)(int number, siginfo_t* info, void* context);

// Replaces a handler that this copy of the code installed earlier for the same signal. The one installed before the
// first stays known, so two copies never call each other alternately. Not real-time safe.
void install_in_front(int number, SignalHandler handler, int more_flags) noexcept;
// Calls the handler that was installed before. Returns false if there was none. If it returns true, the signal has been
// handled.
bool pass_on(int number, siginfo_t* info, void* context) noexcept;

// For SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT: a lost page (core/rt/lost_pages.h) is replaced, guarded code
// (core/rt/guard.h) is ended, anything else is passed on; if there is no earlier handler the process dies of it, with a
// core dump.
void install_fault_handler(int number) noexcept;

}  // namespace indurop::rt
