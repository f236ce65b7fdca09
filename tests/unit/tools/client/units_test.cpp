// SPDX-License-Identifier: Apache-2.0
// Numbers as people read them.
#include "tools/client/text/units.h"

#include <gtest/gtest.h>

namespace indurop::tools {
namespace {

TEST(Units, Durations_have_three_digits_and_a_unit) {
  EXPECT_EQ(human_ns(0), "0 ns");
  EXPECT_EQ(human_ns(812), "812 ns");
  EXPECT_EQ(human_ns(999), "999 ns");
  EXPECT_EQ(human_ns(1000), "1.00 us");
  EXPECT_EQ(human_ns(12'345), "12.3 us");
  EXPECT_EQ(human_ns(123'456), "123 us");
  EXPECT_EQ(human_ns(999'600), "1.00 ms");
  EXPECT_EQ(human_ns(1'240'000), "1.24 ms");
  EXPECT_EQ(human_ns(3'020'000'000), "3.02 s");
  EXPECT_EQ(human_ns(-12'345), "-12.3 us");
  EXPECT_EQ(human_ns(INT64_MAX), "9223372037 s");
}

TEST(Units, Rounding_never_gives_four_digits) {
  EXPECT_EQ(human_ns(9'999), "10.0 us");
  EXPECT_EQ(human_ns(99'960), "100 us");
}

TEST(Units, Ages_are_coarse) {
  EXPECT_EQ(human_age(3'200'000'000), "3.2 s");
  EXPECT_EQ(human_age(59'999'000'000), "0 min 59 s");
  EXPECT_EQ(human_age(252'000'000'000), "4 min 12 s");
  EXPECT_EQ(human_age(7'500'000'000'000), "2 h 05 min");
  EXPECT_EQ(human_age(86'400'000'000'000 * 3), "3 d 0 h");
}

TEST(Units, Bytes_have_binary_units) {
  EXPECT_EQ(human_bytes(512), "512 B");
  EXPECT_EQ(human_bytes(1536), "1.50 KiB");
  EXPECT_EQ(human_bytes(206ULL << 20U), "206 MiB");
  EXPECT_EQ(human_bytes(UINT64_MAX), "16777216 TiB");
}

TEST(Units, Terminal_escapes_in_foreign_text_are_disarmed) {
  EXPECT_EQ(printable("a\x1b[31mb\n\x7f"), "a?[31mb??");
  EXPECT_EQ(printable("\xc2\x9b"), "?");  // the 8-bit form of an escape
  EXPECT_EQ(printable("\xc3\xa4\xff"), "\xc3\xa4?");
  EXPECT_EQ(printable("\xe2\x82"), "??");  // cut in the middle
}

TEST(Units, Width_counts_characters_not_bytes) {
  EXPECT_EQ(display_width("abc"), 3U);
  EXPECT_EQ(display_width("\xc3\xa4\xe2\x82\xac"), 2U);
}

}  // namespace
}  // namespace indurop::tools
