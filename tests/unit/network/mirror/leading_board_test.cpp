// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/leading_board.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace indurop::mirror {
namespace {

constexpr std::uint64_t kYear = 31'557'600ULL * 1'000'000'000;
constexpr std::uint64_t k2026 = 56 * kYear;

TEST(LeadingBoard, Is_the_one_that_started_first) {
  EXPECT_TRUE(leads(k2026, k2026 + 1));
  EXPECT_FALSE(leads(k2026 + 1, k2026));
  EXPECT_FALSE(leads(k2026, k2026)) << "equal ones are decided by the manifest's order";
}

TEST(LeadingBoard, Is_none_that_started_with_its_clock_in_1970_next_to_one_that_knows_the_time) {
  const std::uint64_t seconds_after_1970 = 40ULL * 1'000'000'000;
  EXPECT_FALSE(leads(seconds_after_1970, k2026));
  EXPECT_TRUE(leads(k2026, seconds_after_1970));
  EXPECT_TRUE(leads(seconds_after_1970, seconds_after_1970 + 1)) << "neither knows it";
}

// Otherwise boards that compare in another order would follow different ones.
TEST(LeadingBoard, Is_the_same_in_whatever_order_boards_are_compared) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) {
    std::vector<std::uint64_t> sessions;
    for (int board = 0; board < 4; ++board) {
      sessions.push_back(random() % 2 == 0 ? random() % kYear : k2026 + random() % kYear);
    }
    const std::uint64_t first = *std::min_element(sessions.begin(), sessions.end(), leads);
    std::shuffle(sessions.begin(), sessions.end(), random);
    EXPECT_EQ(*std::min_element(sessions.begin(), sessions.end(), leads), first);
  }
}

}  // namespace
}  // namespace indurop::mirror
