// SPDX-License-Identifier: Apache-2.0
#include "scheduler/tick_wait.h"

#include <gtest/gtest.h>

#include <random>

#include "scheduler/histogram.h"
#include "scheduler/statistics.h"

namespace indurop::scheduler {
namespace {

// Sleeps end `late` ns after they should; reading the clock takes `step`.
class LateClock final : public Kernel {
 public:
  rt::MonoTime now() noexcept override { return rt::mono_time(now_ += step); }
  void sleep_until(rt::MonoTime deadline) noexcept override {
    ++sleeps;
    now_ = std::max(now_, rt::to_ns(deadline) + late);
    woken = now_;
  }
  std::int64_t late = 0;
  std::int64_t step = 20;
  int sleeps = 0;
  std::int64_t woken = 0;

 private:
  std::int64_t now_ = 0;
};

TEST(TickWait, Learns_to_wake_early_enough) {
  LateClock clock;
  clock.late = 30'000;
  TickWait sut(clock, {}, 1'000'000);
  std::int64_t last = 0;
  for (std::int64_t n = 1; n <= 200; ++n) {
    last = rt::to_ns(sut.wait_until(rt::mono_time(n * 1'000'000))) - n * 1'000'000;
  }
  EXPECT_LT(last, 100);
  EXPECT_GT(sut.margin_ns(), 30'000);
  EXPECT_LT(sut.margin_ns(), 50'000);
}

TEST(TickWait, Never_spins_more_than_half_the_period) {
  LateClock clock;
  clock.late = 90'000;
  TickWait sut(clock, {}, 100'000);
  for (std::int64_t n = 1; n <= 2000; ++n) {
    sut.wait_until(rt::mono_time(n * 200'000));
  }
  EXPECT_LE(sut.margin_ns(), 50'000);
}

TEST(TickWait, A_machine_that_is_late_by_milliseconds_is_not_waited_for) {
  LateClock clock;
  clock.late = 3'000'000;
  TickWait sut(clock, {}, 10'000'000);
  for (std::int64_t n = 1; n <= 20'000; ++n) {
    sut.wait_until(rt::mono_time(n * 10'000'000));
  }
  EXPECT_EQ(sut.margin_ns(), TickWait::kMaxSpinNs);
}

// A machine that is sometimes quick and sometimes slow, each in its own way, for a second.
double share_spun(std::int64_t period, std::mt19937& random) {
  const auto up_to = [&random](std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(0, most)(random);
  };
  LateClock clock;
  clock.step = 200;
  TickWait sut(clock, {}, period);
  const std::int64_t quick = up_to(period / 4);
  const std::int64_t slow = quick + up_to(2 * period);
  const std::int64_t seldom = up_to(100);
  const std::int64_t ticks = 1'000'000'000 / period;
  std::int64_t spun = 0;
  for (std::int64_t n = 1; n <= ticks; ++n) {
    const std::int64_t deadline = 3 * n * period;
    clock.late = (up_to(100) < seldom ? slow : quick) + up_to(quick / 4);
    sut.wait_until(rt::mono_time(deadline));
    spun += std::max<std::int64_t>(deadline - clock.woken - clock.step, 0);
  }
  return static_cast<double>(spun) / static_cast<double>(ticks * period);
}

TEST(TickWait, Costs_at_most_a_tenth_of_100_us_and_a_fiftieth_of_1_ms_on_any_machine) {
  std::mt19937 random(20261121);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same machines each time
  for (int machine = 0; machine < 40; ++machine) {
    EXPECT_LE(share_spun(100'000, random), 0.101) << machine;
    EXPECT_LE(share_spun(1'000'000, random), 0.021) << machine;
    EXPECT_LE(share_spun(10'000'000, random), 0.005) << machine;
  }
}

TEST(TickWait, Off_only_sleeps) {
  LateClock clock;
  clock.late = 7'000;
  TickWait sut(clock, {SpinMode::Off, 0}, 1'000'000);
  EXPECT_GE(rt::to_ns(sut.wait_until(rt::mono_time(1'000'000))), 1'007'000);
  EXPECT_EQ(sut.margin_ns(), 0);
}

TEST(TickWait, A_time_in_the_past_returns_at_once) {
  LateClock clock;
  TickWait sut(clock, {}, 1'000'000);
  sut.wait_until(rt::mono_time(-5));
  EXPECT_EQ(clock.sleeps, 0);
}

TEST(Histogram, Every_value_lies_inside_its_bucket) {
  for (std::uint64_t value : {0ULL, 1ULL, 15ULL, 16ULL, 17ULL, 100ULL, 4095ULL, 4096ULL, 123'456'789ULL}) {
    const std::size_t bucket = Histogram::bucket_of(value);
    EXPECT_LE(Histogram::lower_bound(bucket), value);
    EXPECT_GT(Histogram::upper_bound(bucket), value);
  }
  EXPECT_EQ(Histogram::bucket_of(~0ULL), Histogram::kBuckets - 1);
}

TEST(JitterReference, One_late_first_execution_does_not_shift_the_others) {
  Distribution jitter{};
  JitterReference sut;
  sut.add(jitter, 50'000);
  for (int n = 0; n < 99; ++n) {
    sut.add(jitter, 100);
  }
  EXPECT_EQ(jitter.count.load(), 100U);
  EXPECT_EQ(jitter.max.load(), 49'900);
  EXPECT_EQ(jitter.sum.load(), 49'900);
}

TEST(JitterReference, Few_executions_are_counted_at_the_end) {
  Distribution jitter{};
  JitterReference sut;
  sut.add(jitter, 10);
  sut.add(jitter, 30);
  sut.add(jitter, 20);
  EXPECT_EQ(jitter.count.load(), 0U);
  sut.flush(jitter);
  EXPECT_EQ(jitter.count.load(), 3U);
  EXPECT_EQ(jitter.max.load(), 10);
}

}  // namespace
}  // namespace indurop::scheduler
