// SPDX-License-Identifier: Apache-2.0
// Waits for a grid time exactly: sleeps until a margin before it, then spins. The margin follows the machine's own
// wake-up cost (about its 99th percentile), so as little as possible is spent spinning.

#pragma once

#include <cstdint>

#include "scheduler/clock.h"

namespace indurop::scheduler {

enum class SpinMode { Auto, Off, Fixed };

struct SpinSettings {
  SpinMode mode = SpinMode::Auto;
  std::int64_t fixed_ns = 0;  // SpinMode::Fixed
};

class Spinner {
 public:
  // Auto never spins longer than half the period, for the kernel stops real-time threads that use all of a core, nor
  // longer than kMostSpinNs: a machine whose wake-ups are later than that is not made exact by any price.
  static constexpr std::int64_t kMostSpinNs = 150'000;
  Spinner(Clock& clock, const SpinSettings& settings, std::int64_t period_ns) noexcept;

  // Returns the time at which the wait ended, at or after the deadline. Real-time safe.
  rt::MonoTime wait_until(rt::MonoTime deadline) noexcept;
  [[nodiscard]] std::int64_t margin_ns() const noexcept { return margin_; }

 private:
  void learn(std::int64_t wake_cost) noexcept;

  Clock& clock_;
  SpinMode mode_;
  std::int64_t limit_;
  std::int64_t quantile_;
  std::int64_t margin_ = 0;
};

}  // namespace indurop::scheduler
