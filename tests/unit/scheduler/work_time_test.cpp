// SPDX-License-Identifier: Apache-2.0
#include "scheduler/work_time.h"

#include <gtest/gtest.h>

namespace indurop::scheduler {
namespace {

constexpr std::int64_t kPeriod = 1'000'000;

TEST(WorkTime, What_is_left_is_compared_with_the_longest_of_late) {
  WorkTime sut;
  for (int i = 0; i < 100; ++i) {
    sut.add(i == 50 ? 40'000 : 10'000);
  }
  EXPECT_FALSE(sut.does_not_fit(900'000, kPeriod));
  EXPECT_TRUE(sut.does_not_fit(995'000, kPeriod));
  EXPECT_TRUE(sut.does_not_fit(985'000, kPeriod)) << "the one of 40 us is not forgotten yet";
  for (int i = 0; i < 1000; ++i) {
    sut.add(10'000);
  }
  EXPECT_FALSE(sut.does_not_fit(985'000, kPeriod));
}

TEST(WorkTime, Nothing_is_in_vain_in_the_first_half) {
  WorkTime sut;
  sut.add(5 * kPeriod);
  EXPECT_FALSE(sut.does_not_fit(kPeriod / 2, kPeriod));
  EXPECT_TRUE(sut.does_not_fit(kPeriod / 2 + 1, kPeriod));
}

}  // namespace
}  // namespace indurop::scheduler
