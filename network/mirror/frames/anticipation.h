// SPDX-License-Identifier: Apache-2.0
// Predicts when the schedule will next have written. Waking a thread on an idle core costs more than sending a frame; a
// sender that is already awake when the modules finish avoids this cost. It measures when ticks are reported and spins
// for a short while around the next time; without a steady period it only sleeps. Pure arithmetic, one thread.

#pragma once

#include <cstdint>

namespace indurop::mirror {

class Anticipation {
 public:
  // The sender is awake from kBefore ns before the expected time until kAfter ns after it.
  static constexpr std::int64_t kBefore = 60'000;
  static constexpr std::int64_t kAfter = 40'000;
  // The sender spins for at most a tenth of the time.
  static constexpr std::int64_t kShortestPeriod = 10 * (kBefore + kAfter);

  struct Window {
    std::int64_t begin = 0;
    std::int64_t end = 0;
    [[nodiscard]] bool empty() const noexcept { return begin == end; }
  };

  // Reports at `now_ns` that the work of basic period number `tick` is done.
  void reported(std::uint64_t tick, std::int64_t now_ns) noexcept {
    if (tick <= tick_) {
      return;  // later bands of the same period
    }
    if (tick_ != 0) {
      const std::int64_t sample = (now_ns - last_ns_) / static_cast<std::int64_t>(tick - tick_);
      const bool near = sample > period_ns_ - period_ns_ / 8 && sample < period_ns_ + period_ns_ / 8;
      steady_ = near ? steady_ + 1 : 0;
      period_ns_ = near ? period_ns_ + (sample - period_ns_) / 8 : sample;
    }
    tick_ = tick;
    last_ns_ = now_ns;
  }

  // Returns when to be awake next; empty if the period is unknown or too short.
  [[nodiscard]] Window next(std::int64_t now_ns) const noexcept {
    if (steady_ < kSteady || period_ns_ < kShortestPeriod) {
      return {};
    }
    const std::int64_t expected = last_ns_ + period_ns_;
    return now_ns < expected + kAfter ? Window{expected - kBefore, expected + kAfter} : Window{};
  }

 private:
  static constexpr int kSteady = 8;  // consecutive periods

  std::uint64_t tick_ = 0;
  std::int64_t last_ns_ = 0;
  std::int64_t period_ns_ = 0;
  int steady_ = 0;
};

}  // namespace indurop::mirror
