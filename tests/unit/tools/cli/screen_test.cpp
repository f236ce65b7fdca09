// SPDX-License-Identifier: Apache-2.0
// Lines that fit on the screen.
#include "tools/cli/command/screen.h"

#include <gtest/gtest.h>

namespace indurop::tools {
namespace {

TEST(CutToWidth, Counts_characters_and_leaves_short_lines_alone) {
  EXPECT_EQ(cut_to_width("abc", 3), "abc");
  EXPECT_EQ(cut_to_width("abcd", 3), "abc");
  EXPECT_EQ(cut_to_width("\xc3\xa4\xc3\xb6\xc3\xbc", 2), "\xc3\xa4\xc3\xb6");
  EXPECT_EQ(cut_to_width("", 0), "");
}

TEST(CutToWidth, Colours_take_no_place_and_are_switched_off_after_the_cut) {
  EXPECT_EQ(cut_to_width("\x1b[1mabcd\x1b[0m", 2), "\x1b[1mab\x1b[0m");
}

}  // namespace
}  // namespace indurop::tools
