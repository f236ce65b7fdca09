// SPDX-License-Identifier: Apache-2.0
// Keeps the programs of a simulated plant on one core as long as their work between two messages is short: waking a
// program on another core takes longer than that. The values are the same either way.

#pragma once

#include <sched.h>
#include <sys/types.h>

#include <chrono>
#include <vector>

namespace indurop::node {

class OneCore {
 public:
  // Uses the core the caller is on.
  OneCore() noexcept;

  // Adds the main thread of a program that has just been started.
  void add(pid_t program);
  // All programs have finished a round, and took this much processor time together. From time to time decides whether
  // to spread them over all cores, or to gather them again.
  void round(std::chrono::nanoseconds took);

 private:
  void place() const noexcept;

  cpu_set_t all_{};
  cpu_set_t one_{};
  bool gathered_ = true;
  std::vector<pid_t> programs_;
  std::chrono::nanoseconds took_{};
  int rounds_ = 0;
};

}  // namespace indurop::node
