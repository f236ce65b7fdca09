// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and SIGTERM while a verb works or waits: they end the wait, the verb tidies up and the program exits with
// 128 + signal. Waits of all verbs go through here, so none is unbounded.

#pragma once

#include <cstdint>

namespace indurop::tools {

// Catches SIGINT and SIGTERM, ignores SIGPIPE (a gone reader shows as EPIPE). Once, at the start of main.
void catch_interrupts();
[[nodiscard]] bool interrupted() noexcept;
[[nodiscard]] int interrupt_code() noexcept;  // 130, 143
// For a verb that Ctrl-C ends as wished: what it does at its end may wait again, and its code is that of the program.
// The next Ctrl-C ends the program.
void take_interrupt() noexcept;

// As long as one lives, SIGINT and SIGTERM end the program at once: for work that asks for no signal, however long it
// takes, and leaves nothing to tidy up.
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
