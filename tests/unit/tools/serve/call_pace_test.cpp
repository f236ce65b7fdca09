// SPDX-License-Identifier: Apache-2.0
// How many calls of shared functions begin in a second.

#include "tools/serve/api/call_pace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace indurop::serve {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

TEST(CallPaces, Let_no_more_than_ten_begin_in_any_second) {
  std::mt19937_64 random(3);
  CallPace sut;
  std::vector<std::int64_t> begun;
  std::size_t refused = 0;
  for (std::int64_t now = 1; begun.size() < 2000; now += static_cast<std::int64_t>(random() % (kSecondNs / 6))) {
    if (sut.begin(now)) {
      begun.push_back(now);
      continue;
    }
    ++refused;
    const auto in_this_second =
        std::count_if(begun.begin(), begun.end(), [now](std::int64_t one) { return now - one < kSecondNs; });
    EXPECT_EQ(in_this_second, 10) << "none is refused without need";
  }
  EXPECT_GT(refused, 100U);
  for (std::size_t i = CallPace::kMostInASecond; i < begun.size(); ++i) {
    EXPECT_GE(begun[i] - begun[i - CallPace::kMostInASecond], kSecondNs);
  }
}

}  // namespace
}  // namespace indurop::serve
