// SPDX-License-Identifier: Apache-2.0
// Keeps the programs of a simulated plant on one core as long as what they do between two words is short: waking a
// program on another core takes longer than that. The values are the same either way.

#pragma once

#include <sched.h>
#include <sys/types.h>

#include <chrono>
#include <vector>

namespace indurop::node {

class OneCore {
 public:
  // On the core the caller is on.
  OneCore() noexcept;

  // The main thread of a program, which has just been started.
  void add(pid_t program);
  // All have done what they were told, and took so much processor time for it together. Looks from time to time
  // whether they had better be spread over all cores, or gathered again.
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
