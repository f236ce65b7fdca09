// SPDX-License-Identifier: Apache-2.0
// Distinguishes a living process from a dead one whose pid was reused.

#pragma once

#include <sys/types.h>

#include <cstdint>

namespace indurop::vars {

// Field 22 of /proc/PID/stat: when the process started, in clock ticks since boot. 0 if there is no such process.
// Not real-time safe.
std::uint64_t process_start_time(pid_t pid) noexcept;

// Returns true if `pid` exists, is no zombie, and started at `start_time`.
bool process_alive(pid_t pid, std::uint64_t start_time) noexcept;

}  // namespace indurop::vars
