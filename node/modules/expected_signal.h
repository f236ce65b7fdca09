// SPDX-License-Identifier: Apache-2.0
// Checks whether a program is ready for the signal that will wake it. Before that, the signal would end it.

#pragma once

#include <sys/types.h>

namespace indurop::node {

// Returns true if the process catches, ignores or blocks the signal, or one of its threads waits for signals. Not
// real-time safe.
bool expects_signal(pid_t process, int signal);

// Returns true if the process has received the pending signal of this kind and waits again. Reads /proc: not real-time
// safe.
bool has_dealt_with(pid_t process, int signal);

}  // namespace indurop::node
