// SPDX-License-Identifier: Apache-2.0
// Names, globs and ranges as arguments give them.
#include "tools/client/values/variables.h"

#include <gtest/gtest.h>

#include <limits>

namespace indurop::tools {
namespace {

TEST(IsGlob, An_index_is_no_set_of_letters) {
  EXPECT_FALSE(is_glob("joints[1].y"));
  EXPECT_FALSE(is_glob("grid[0][12]"));
  EXPECT_FALSE(is_glob("knu::Robot::tick"));
  EXPECT_TRUE(is_glob("knu::*"));
  EXPECT_TRUE(is_glob("joint?"));
  EXPECT_TRUE(is_glob("[a-z]oint"));
  EXPECT_TRUE(is_glob("x[0-9]"));
  EXPECT_FALSE(is_glob("x["));
}

TEST(RangeText, An_open_end_is_left_out) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(range_text(schema::Range{0, 10}), "0..10");
  EXPECT_EQ(range_text(schema::Range{-0.5, kInfinite}), "-0.5..");
  EXPECT_EQ(range_text(schema::Range{-kInfinite, 2}), "..2");
  EXPECT_EQ(range_text({}), "");
}

}  // namespace
}  // namespace indurop::tools
