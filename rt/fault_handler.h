// SPDX-License-Identifier: Apache-2.0
// The handlers of this process for signals of faults. They stand in front of those that were there before, such as a
// user's or those of another copy of this code, which a library has for itself.

#pragma once

#include <csignal>

namespace indurop::rt {

using SignalHandler = void (*)(int number, siginfo_t* info, void* context);

// A handler that was installed before for the same signal by this copy of the code is replaced and forgotten; what
// stood there before the first one stays known, so two copies never call each other in turn. Not real-time safe.
void install_in_front(int number, SignalHandler handler, int more_flags) noexcept;
// Calls what stood there before. False: nothing did. If it returns it has dealt with the signal.
bool pass_on(int number, siginfo_t* info, void* context) noexcept;

// For SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT: a lost page (rt/lost_pages.h) is replaced, guarded code (rt/guard.h)
// is ended, anything else is passed on; with nobody to pass it on to the process dies of it, with a core dump.
void install_fault_handler(int number) noexcept;

}  // namespace indurop::rt
