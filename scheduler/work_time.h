// SPDX-License-Identifier: Apache-2.0
// How long the work of a tick takes in its thread, to tell whether what is left of a basic period is enough for it. A
// machine that stood still often lets a tick begin just before the next one: whatever runs then runs into the next, and
// looks as if it were the one that took too long. Such a tick is lost, and nobody's fault. Real-time safe.

#pragma once

#include <algorithm>
#include <cstdint>

namespace indurop::scheduler {

class WorkTime {
 public:
  // Of a tick that was run.
  void add(std::int64_t ns) noexcept { longest_ = std::max(ns, longest_ - longest_ / kForget); }
  // A tick that begins `late` cannot end before the next release. Never for one in the first half of its period: what
  // does not fit there does not fit at all, and is to be seen as an overrun.
  [[nodiscard]] bool does_not_fit(std::int64_t late, std::int64_t basic_period) const noexcept {
    return late > basic_period / 2 && late + std::min(longest_, basic_period / 2) > basic_period;
  }

 private:
  static constexpr std::int64_t kForget = 64;  // the longest of about so many ticks counts
  std::int64_t longest_ = 0;
};

}  // namespace indurop::scheduler
