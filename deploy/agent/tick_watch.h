// SPDX-License-Identifier: Apache-2.0
// Detects a node that hangs: it exists, its schedule should run, but its tick does not advance.

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "core/rt/clock.h"
#include "scheduler/run_block.h"

namespace indurop::deploy {

class TickWatch {
 public:
  // A tick may last this long, plus three basic periods.
  static constexpr std::chrono::seconds kPatience{3};

  // Another node is monitored from now on.
  void reset() noexcept { seen_.reset(); }
  // To be called repeatedly. Returns how long the tick has not advanced, if that is too long. Time in which nothing
  // called it, because the whole machine was suspended, does not count. A node that has a thread module without a
  // budget is never judged: such a module may run for any time.
  std::optional<std::chrono::nanoseconds> check(const scheduler::RunBlock& block, rt::MonoTime now);

 private:
  std::optional<std::uint64_t> seen_;  // tick
  rt::MonoTime checked_{};
  std::chrono::nanoseconds stood_{};
};

}  // namespace indurop::deploy
