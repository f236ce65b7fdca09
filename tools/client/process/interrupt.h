// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM while a verb works or waits: they end the wait, the verb cleans up and the program exits with 128
// + signal. All waits of verbs use this, so none is unbounded.

#pragma once

#include <cstdint>

namespace indurop::tools {

// Catches SIGINT and SIGTERM, ignores SIGPIPE (a reader that has gone shows as EPIPE). To be called once, at the start
// of main.
void catch_interrupts();
[[nodiscard]] bool interrupted() noexcept;
[[nodiscard]] int interrupt_code() noexcept;  // 130, 143
// For a verb that Ctrl-C ends normally: its cleanup may wait again, and it sets its own exit code. The next Ctrl-C ends
// the program.
void take_interrupt() noexcept;

// While an instance exists, SIGINT and SIGTERM end the program at once: for work that does not check for signals,
// however long it takes, and that leaves nothing to clean up.
class EndsAtOnce {
 public:
  EndsAtOnce() noexcept;
  EndsAtOnce(const EndsAtOnce&) = delete;
  EndsAtOnce& operator=(const EndsAtOnce&) = delete;
  ~EndsAtOnce();
};

// Sleeps until CLOCK_MONOTONIC `deadline_ns` or a signal, or, if `fd` >= 0, until it can be read.
enum class Woken { Deadline, Signal, Readable };
Woken wait_until(std::int64_t deadline_ns, int fd = -1) noexcept;

}  // namespace indurop::tools
