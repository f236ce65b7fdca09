// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/board_boxes.h"

#include <gtest/gtest.h>

namespace indurop::tools {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(Boxes_of_moment, Are_the_nearest_of_each_board_within_ten_seconds) {
  const std::vector<BoardBox> all = {{"a", 1, "a3", "", 0, 130 * kSecond}, {"b", 2, "b2", "", 0, 127 * kSecond},
                                     {"a", 1, "a2", "", 0, 121 * kSecond}, {"b", 2, "b1", "", 0, 119 * kSecond},
                                     {"c", 3, "c1", "", 0, 100 * kSecond}, {"d", 4, "d1", "", 0, 0}};
  const auto names = [&](std::int64_t moment) {
    std::string text;
    for (const BoardBox& box : boxes_of_moment(all, moment * kSecond)) {
      text += box.name + " ";
    }
    return text;
  };
  EXPECT_EQ(names(130), "a3 b2 ");
  EXPECT_EQ(names(121), "a2 b1 ");
  EXPECT_EQ(names(100), "c1 ");
  EXPECT_EQ(names(1000), "");
}

}  // namespace
}  // namespace indurop::tools
