// SPDX-License-Identifier: Apache-2.0
#include "scheduler/late_ticks.h"

#include <gtest/gtest.h>

#include <memory>

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kPeriod = 1'000'000;

TEST(LateTicks, What_is_left_is_compared_with_the_longest_of_late) {
  LateTicks sut(kPeriod);
  for (int i = 0; i < 100; ++i) {
    sut.add_work(i == 50 ? 40'000 : 10'000);
  }
  EXPECT_FALSE(sut.start(900'000).in_vain);
  EXPECT_TRUE(sut.start(995'000).in_vain);
  EXPECT_TRUE(sut.start(985'000).in_vain) << "the one of 40 us is not forgotten yet";
  for (int i = 0; i < 1000; ++i) {
    sut.add_work(10'000);
  }
  EXPECT_FALSE(sut.start(985'000).in_vain);
}

TEST(LateTicks, Nothing_is_in_vain_in_the_first_half) {
  LateTicks sut(kPeriod);
  sut.add_work(5 * kPeriod);
  EXPECT_FALSE(sut.start(kPeriod / 2).in_vain);
  EXPECT_TRUE(sut.start(kPeriod / 2 + 1).in_vain);
}

TEST(LateTicks, Periods_that_have_passed_are_lost_and_so_is_a_tick_in_vain) {
  LateTicks sut(kPeriod);
  sut.add_work(kPeriod / 4);
  EXPECT_EQ(sut.start(0).lost(), 0U);
  EXPECT_EQ(sut.start(kPeriod - 1).lost(), 1U);
  EXPECT_EQ(sut.start(3 * kPeriod).lost(), 3U);
  EXPECT_EQ(sut.start(4 * kPeriod - 1).lost(), 4U);
  EXPECT_EQ(sut.start(4 * kPeriod - 1).passed, 3U);
}

TEST(LateTicks, Are_counted_with_their_lateness) {
  const auto block = std::make_unique<RunBlock>();
  LateTicks::count(*block, 2 * kPeriod, LateTicks(kPeriod).start(2 * kPeriod));
  LateTicks::count(*block, 100, LateTicks(kPeriod).start(100));
  EXPECT_EQ(block->lost_ticks.load(), 2U);
  EXPECT_EQ(block->tick_lateness.count.load(), 2U);
}

}  // namespace
}  // namespace indurop::scheduler
