// SPDX-License-Identifier: Apache-2.0
// How long the work of a tick takes in its thread, to decide whether the rest of a basic period is enough for it. A
// machine that was suspended often lets a tick begin just before the next one: a module that runs then overlaps the
// next tick and looks as if it were too slow. Such a tick counts as lost, and no module is blamed. Real-time safe.

#pragma once

#include <algorithm>
#include <cstdint>

namespace indurop::scheduler {

class WorkTime {
 public:
  // Adds the time of a tick that was run.
  void add(std::int64_t ns) noexcept { longest_ = std::max(ns, longest_ - longest_ / kForget); }
  // Returns true if a tick that begins `late` cannot end before the next release. Never for one in the first half of
  // its period: work that does not fit there never fits, and must appear as an overrun.
  [[nodiscard]] bool does_not_fit(std::int64_t late, std::int64_t basic_period) const noexcept {
    return late > basic_period / 2 && late + std::min(longest_, basic_period / 2) > basic_period;
  }

 private:
  static constexpr std::int64_t kForget = 64;  // the longest of about this many ticks counts
  std::int64_t longest_ = 0;
};

}  // namespace indurop::scheduler
