// SPDX-License-Identifier: Apache-2.0
// Turns SIGINT, SIGTERM and SIGHUP into a state to poll. They are blocked in every thread, so construct it before any.
// SIGHUP stays ignored if it was before, as nohup(1) starts programs.

#pragma once

#include <chrono>
#include <csignal>

namespace indurop::base {

// Returns true if this process ignores the signal; it may have inherited that from the program that started it.
bool is_ignored(int number) noexcept;

class StopSignal {
 public:
  StopSignal() noexcept;
  // Waits at most `timeout` for a stop signal or the end of a child. Returns the stop signal received so far, 0 if
  // none.
  int wait(std::chrono::nanoseconds timeout) noexcept;
  [[nodiscard]] int received() const noexcept { return received_; }

 private:
  sigset_t set_{};
  int received_ = 0;
};

}  // namespace indurop::base
