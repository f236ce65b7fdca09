// SPDX-License-Identifier: Apache-2.0
// Which ticks are lost because one begins too late, and the counts of it. A machine that was suspended often lets a
// tick begin just before the next one: a module that runs then overlaps the next tick and looks as if it were too slow.
// Such a tick counts as lost, and no module is blamed. Real-time safe.

#pragma once

#include <algorithm>
#include <cstdint>

#include "scheduler/run_block.h"
#include "scheduler/statistics.h"

namespace indurop::scheduler {

// Of one core. Used by its tick thread.
class LateTicks {
 public:
  explicit LateTicks(std::int64_t basic_period_ns) noexcept : basic_(basic_period_ns) {}

  struct Start {
    std::uint64_t passed = 0;  // ticks whose whole period has passed
    bool in_vain = false;      // the tick that is due now cannot end before the next one, and is not run
    [[nodiscard]] std::uint64_t lost() const noexcept { return passed + (in_vain ? 1 : 0); }
  };
  // `late`: how long after its planned time a tick begins, in ns. It is never in vain in the first half of its period:
  // work that does not fit there never fits, and must appear as an overrun.
  [[nodiscard]] Start start(std::int64_t late) const noexcept {
    const std::int64_t within = late % basic_;
    const bool fits = within <= basic_ / 2 || within + std::min(longest_, basic_ / 2) <= basic_;
    return {static_cast<std::uint64_t>(late / basic_), !fits};
  }
  // Adds a tick to the counts of the node.
  static void count(RunBlock& block, std::int64_t late, const Start& start) noexcept {
    add_sample(block.tick_lateness, late);
    if (start.lost() > 0) {
      block.lost_ticks.fetch_add(start.lost(), std::memory_order_relaxed);
    }
  }
  // Adds the time that the work of a tick took in its thread.
  void add_work(std::int64_t ns) noexcept { longest_ = std::max(ns, longest_ - longest_ / kForget); }

 private:
  static constexpr std::int64_t kForget = 64;  // the longest of about this many ticks counts
  std::int64_t basic_;
  std::int64_t longest_ = 0;
};

}  // namespace indurop::scheduler
