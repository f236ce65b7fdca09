// SPDX-License-Identifier: Apache-2.0
// Sees that a node hangs: it is there, its schedule should run, and its tick stands still.

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "rt/clock.h"
#include "scheduler/run_block.h"

namespace indurop::deploy {

class TickWatch {
 public:
  // A tick may stand for so long, and for three basic periods more.
  static constexpr std::chrono::seconds kPatience{3};

  // Another node is watched from now on.
  void reset() noexcept { seen_.reset(); }
  // Looked at again and again. How long the tick has stood, if that is too long. Time in which nobody looked, because
  // the whole machine stood still, does not count. A node that has a thread module without a budget is never judged:
  // such a module may take as long as it wants.
  std::optional<std::chrono::nanoseconds> look(const scheduler::RunBlock& block, rt::MonoTime now);

 private:
  std::optional<std::uint64_t> seen_;  // tick
  rt::MonoTime looked_{};
  std::chrono::nanoseconds stood_{};
};

}  // namespace indurop::deploy
