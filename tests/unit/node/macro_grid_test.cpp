// SPDX-License-Identifier: Apache-2.0
// In which ticks macro periods begin after changes of the schedule, against a search through all ticks.

#include "node/exchange/macro_grid.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numeric>
#include <random>

namespace indurop::node {
namespace {

constexpr std::int64_t kBasic = 1'000'000;

// Distance of a time from a multiple of `period`.
std::int64_t apart(std::int64_t time, std::int64_t period) {
  const std::int64_t past = (time % period + period) % period;
  return std::min(past, period - past);
}

TEST(MacroGrid, Of_a_node_without_a_plant_begins_with_tick_0) {
  EXPECT_EQ(following_grid({10, 0}, 6, kBasic, std::nullopt), (MacroGrid{6, 0}));
}

TEST(MacroGrid, Of_boards_that_began_at_different_times_begins_together) {
  // Tick 0 of one board is at 10 ms, that of the other at 50 ms.
  EXPECT_EQ(following_grid({10, 0}, 30, kBasic, 10 * kBasic), (MacroGrid{30, 20}));
  EXPECT_EQ(following_grid({10, 0}, 30, kBasic, 50 * kBasic), (MacroGrid{30, 10}));
  EXPECT_EQ(following_grid({30, 20}, 10, kBasic, 10 * kBasic), (MacroGrid{10, 0})) << "and back";
}

TEST(MacroGrid, Is_as_near_to_the_wall_clock_as_modules_that_stay_allow) {
  std::minstd_rand random(1);
  const auto below = [&random](std::uint64_t limit) { return random() % limit; };
  for (int i = 0; i < 2'000; ++i) {
    const MacroGrid before{1 + below(30), 0};
    const MacroGrid from{before.ticks, below(before.ticks)};
    const std::uint64_t ticks = 1 + below(30);  // both meet within a second
    const auto epoch = static_cast<std::int64_t>(below(100'000'000)) - 50'000'000;
    const MacroGrid sut = following_grid(from, ticks, kBasic, epoch);
    const std::uint64_t shared = std::gcd(from.ticks, ticks);
    ASSERT_LT(sut.begin, ticks);
    ASSERT_EQ(sut.begin % shared, from.begin % shared) << "a module that stays would be released at other times";
    const auto distance = [&](std::uint64_t begin) {
      return apart(epoch + static_cast<std::int64_t>(begin) * kBasic, static_cast<std::int64_t>(ticks) * kBasic);
    };
    for (std::uint64_t other = from.begin % shared; other < ticks; other += shared) {
      ASSERT_LE(distance(sut.begin), distance(other));
    }
    const MacroGrid common = common_grid(from, sut, kBasic);
    ASSERT_EQ(common.ticks, std::lcm(from.ticks, ticks));
    ASSERT_EQ(common.begin % from.ticks, from.begin);
    ASSERT_EQ(common.begin % ticks, sut.begin);
  }
}

TEST(MacroGrid, Longer_than_a_second_is_not_waited_for) {
  EXPECT_EQ(common_grid({40, 3}, {41, 3}, kBasic), (MacroGrid{40, 3}));
  EXPECT_EQ(common_grid({40, 3}, {41, 3}, kBasic / 10), (MacroGrid{1640, 3}));
  EXPECT_EQ(common_grid({2'000, 3}, {2'000, 3}, kBasic), MacroGrid{});
}

TEST(MacroGrid, Next_is_the_first_tick_that_is_not_before) {
  EXPECT_EQ(next_in({10, 3}, 0), 3U);
  EXPECT_EQ(next_in({10, 3}, 3), 3U);
  EXPECT_EQ(next_in({10, 3}, 4), 13U);
  EXPECT_EQ(next_in({1, 0}, 4), 4U);
  EXPECT_EQ(next_in({10, 23}, 4), 13U) << "of whatever period";
}

}  // namespace
}  // namespace indurop::node
