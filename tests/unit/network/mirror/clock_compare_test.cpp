// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/clock_compare.h"

#include <gtest/gtest.h>

namespace indurop::mirror {
namespace {

TEST(Clock_compare, The_way_cancels_out) {
  ClockCompare sut;
  sut.arrived(5000 + 20);  // our clock is 5000 ahead, the way takes 20
  const auto offset = sut.offset(-5000 + 20);
  EXPECT_EQ(offset.ns, 5000);
  EXPECT_EQ(offset.bound, 20);
}

TEST(Clock_compare, An_uneven_way_stays_within_the_bound) {
  ClockCompare sut;
  sut.arrived(-700 + 90);
  const auto offset = sut.offset(700 + 10);
  EXPECT_LE(std::abs(offset.ns - -700), offset.bound);
}

TEST(Clock_compare, The_fastest_of_the_last_stamps_counts) {
  ClockCompare sut;
  for (const std::int64_t delay : {500, 90, 3000}) {
    sut.arrived(delay);
  }
  EXPECT_EQ(sut.least_delay(), 90);
  for (int i = 0; i < 16; ++i) {
    sut.arrived(200);
  }
  EXPECT_EQ(sut.least_delay(), 200) << "old ones are forgotten, clocks drift";
  sut.reset();
  EXPECT_FALSE(sut.has_samples());
}

}  // namespace
}  // namespace indurop::mirror
