// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/library/steps.h"

#include <gmock/gmock.h>

#include <limits>
#include <random>

namespace indurop::fmi {
namespace {

using namespace std::chrono_literals;

TEST(Steps, A_tick_lies_in_the_step_that_begins_with_it) {
  const Steps sut(1ms, 0, std::nullopt);
  EXPECT_EQ(sut.ticks_at_end(0, 1e-3), 1U);
  EXPECT_EQ(sut.ticks_at_end(0, 0.4e-3), 1U);
  EXPECT_EQ(sut.ticks_at_end(0.4e-3, 0.6e-3), 1U);
  EXPECT_EQ(sut.ticks_at_end(0, 1.4e-3), 2U);
  EXPECT_EQ(sut.ticks_at_end(0, 1e-9), 0U) << "a thousandth of a basic period does not count";
}

// The yardstick counts in whole nanoseconds.
TEST(Steps, No_tick_is_lost_or_run_twice_whatever_the_steps_are) {
  std::mt19937_64 random(5);
  for (const std::int64_t period : {100'000, 1'000'000, 333'333, 20'000'000}) {
    Steps sut{std::chrono::nanoseconds(period), -3.25, std::nullopt};
    std::int64_t exact = 0;
    for (int i = 0; i < 20'000; ++i) {
      // Multiples of the basic period, and anything else that is not close to one.
      const std::int64_t size = random() % 3 == 0 ? period * static_cast<std::int64_t>(1 + random() % 7)
                                                  : period / 100 * static_cast<std::int64_t>(1 + random() % 400);
      const double at = sut.now();
      const double seconds = static_cast<double>(size) * 1e-9;
      ASSERT_EQ(sut.problem_of(at, seconds), "");
      exact += size;
      const std::int64_t after = exact % period;
      if (after == 0 || (after > period / 500 && after < period - period / 500)) {
        ASSERT_EQ(sut.ticks_at_end(at, seconds), static_cast<std::uint64_t>((exact + period - 1) / period)) << i;
      }
      sut.end_at(at + seconds);
    }
  }
}

TEST(Steps, Says_which_steps_are_not_possible) {
  Steps sut(1ms, 5, 6);
  EXPECT_EQ(sut.problem_of(5, 1), "");
  EXPECT_NE(sut.problem_of(5, 1.1), "");
  EXPECT_NE(sut.problem_of(4.9, 0.1), "");
  EXPECT_NE(sut.problem_of(5, 0), "");
  EXPECT_NE(sut.problem_of(5, -1), "");
  EXPECT_NE(sut.problem_of(5, std::numeric_limits<double>::infinity()), "");
  EXPECT_NE(sut.problem_of(std::numeric_limits<double>::quiet_NaN(), 1), "");
  EXPECT_NE(Steps(1ms, 0, std::nullopt).problem_of(0, 1e300), "");
  sut.end_at(5.5);
  EXPECT_NE(sut.problem_of(5, 0.1), "");
  EXPECT_EQ(sut.problem_of(5.5 + 1e-7, 0.1), "");
}

}  // namespace
}  // namespace indurop::fmi
