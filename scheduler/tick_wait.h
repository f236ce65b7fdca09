// SPDX-License-Identifier: Apache-2.0
// Waits for a grid time exactly: sleeps until a margin before it, then spins. The margin follows the machine's own
// wake-up cost (about its 99th percentile), so that as little as possible is spent spinning, within a limit on its
// cost.

#pragma once

#include <cstdint>

#include "scheduler/kernel.h"

namespace indurop::scheduler {

enum class SpinMode { Auto, Off, Fixed };

struct SpinSettings {
  SpinMode mode = SpinMode::Auto;
  std::int64_t fixed_ns = 0;  // SpinMode::Fixed
};

class TickWait {
 public:
  // Auto never spins longer than half the period, because the kernel stops real-time threads that use all of a core,
  // nor longer than kMaxSpinNs: a machine with later wake-ups does not become exact at any cost. The average spin is
  // limited as well, whatever the machine does: a tenth of a period of 100 us, a fiftieth of 1 ms.
  static constexpr std::int64_t kMaxSpinNs = 150'000;
  static constexpr std::int64_t kMaxMeanNs = 20'000;
  static constexpr std::int64_t kMaxMeanShare = 10;  // one part in this many of the period
  TickWait(Clock& clock, const SpinSettings& settings, std::int64_t period_ns) noexcept;

  // Returns the time at which the wait ended, at or after the deadline. Real-time safe.
  rt::MonoTime wait_until(rt::MonoTime deadline) noexcept;
  [[nodiscard]] std::int64_t margin_ns() const noexcept { return margin_; }

 private:
  void learn(std::int64_t wake_cost, std::int64_t spin) noexcept;

  Clock& clock_;
  SpinMode mode_;
  std::int64_t limit_;
  std::int64_t budget_;  // maximum mean spin, ns
  std::int64_t credit_;  // unused spin budget of all ticks so far, ns
  std::int64_t quantile_;
  std::int64_t margin_ = 0;
};

}  // namespace indurop::scheduler
