// SPDX-License-Identifier: Apache-2.0
// Is a program ready for the signal that is to wake it? Before that, the signal would end it.

#pragma once

#include <sys/types.h>

namespace indurop::node {

// True if the process catches, ignores or blocks the signal, or one of its threads waits for signals. Not real-time
// safe.
bool expects_signal(pid_t process, int signal);

// It has taken what it was sent of this signal, and waits again. Reads /proc: not real-time safe.
bool has_dealt_with(pid_t process, int signal);

}  // namespace indurop::node
