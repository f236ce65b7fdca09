// SPDX-License-Identifier: Apache-2.0
// Shifts and rotations at and beyond the width, logic on BOOL and bit strings, single bits.

#include <gtest/gtest.h>
#include <indurop/plc/bits.h>

namespace indurop::iec {
namespace {

using Byte = std::uint8_t;
using Word = std::uint16_t;

TEST(PlcBits, Shifts_fill_with_zeros_and_lose_everything_from_the_width_on) {
  struct Row {
    Byte in;
    int n;
    Byte left, right;
  };
  for (const auto& [in, n, left, right] :
       {Row{0x81, 0, 0x81, 0x81}, Row{0x81, 1, 0x02, 0x40}, Row{0x81, 7, 0x80, 0x01}, Row{0xFF, 8, 0, 0},
        Row{0xFF, 9, 0, 0}, Row{0xFF, 64, 0, 0}, Row{0xFF, 2'000'000'000, 0, 0}, Row{0x81, -1, 0x81, 0x81}}) {
    EXPECT_EQ(shl(in, n), left) << n;
    EXPECT_EQ(shr(in, n), right) << n;
  }
  EXPECT_EQ(shl(~std::uint64_t{0}, 63), std::uint64_t{1} << 63);
  EXPECT_EQ(shl(~std::uint64_t{0}, 64), 0U);
  EXPECT_EQ(shr(~std::uint64_t{0}, std::uint64_t{1} << 40), 0U);
  EXPECT_EQ(shl(std::uint32_t{1}, std::uint8_t{31}), 0x80000000U);
}

TEST(PlcBits, Rotations_go_around) {
  struct Row {
    Byte in;
    int n;
    Byte left, right;
  };
  for (const auto& [in, n, left, right] :
       {Row{0x81, 0, 0x81, 0x81}, Row{0x81, 1, 0x03, 0xC0}, Row{0x81, 4, 0x18, 0x18}, Row{0x81, 8, 0x81, 0x81},
        Row{0x81, 9, 0x03, 0xC0}, Row{0x81, -1, 0xC0, 0x03}, Row{0x81, 8001, 0x03, 0xC0}}) {
    EXPECT_EQ(rol(in, n), left) << n;
    EXPECT_EQ(ror(in, n), right) << n;
  }
  EXPECT_EQ(rol(Word{0x8001}, 1), 0x0003);
  EXPECT_EQ(rol(std::uint32_t{0x80000001}, 33), 0x00000003U);
  EXPECT_EQ(ror(std::uint64_t{1}, 1), std::uint64_t{1} << 63);
  EXPECT_EQ(rol(std::uint64_t{1}, ~std::uint64_t{0}), std::uint64_t{1} << 63);
}

TEST(PlcBits, A_bool_is_one_bit_wide) {
  EXPECT_TRUE(shl(true, 0));
  EXPECT_FALSE(shl(true, 1));
  EXPECT_FALSE(shr(true, 1));
  EXPECT_TRUE(rol(true, 5));
  EXPECT_FALSE(ror(false, 5));
}

TEST(PlcBits, Logic_of_any_number_of_operands) {
  EXPECT_EQ(bit_and(Byte{0xF3}, Byte{0x3F}, Byte{0x31}), 0x31);
  EXPECT_EQ(bit_or(Byte{0x01}, Byte{0x10}, Byte{0x80}), 0x91);
  EXPECT_EQ(bit_xor(Byte{0xFF}, Byte{0x0F}, Byte{0x01}), 0xF1);
  EXPECT_EQ(bit_not(Byte{0xF0}), 0x0F);
  EXPECT_EQ(bit_not(Word{0}), 0xFFFF);
  EXPECT_TRUE(bit_and(true, true, true));
  EXPECT_FALSE(bit_and(true, false));
  EXPECT_TRUE(bit_or(false, true));
  EXPECT_TRUE(bit_xor(true, true, true));
  EXPECT_FALSE(bit_not(true));
  EXPECT_TRUE(bit_not(false));
}

TEST(PlcBits, Single_bits_are_read_and_set) {
  Word word = 0x0008;
  EXPECT_TRUE(bit(word, 3));
  EXPECT_FALSE(bit(word, 2));
  set_bit(word, 15, true);
  set_bit(word, 3, false);
  EXPECT_EQ(word, 0x8000);
  std::int8_t number = 0;
  set_bit(number, 7, true);
  EXPECT_EQ(number, -128);
  EXPECT_TRUE(bit(number, 7));
}

}  // namespace
}  // namespace indurop::iec
