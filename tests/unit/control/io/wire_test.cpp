// SPDX-License-Identifier: Apache-2.0
// Numbers in registers: every type in every order, limits.
#include "control/io/wire.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>

namespace indurop::io {
namespace {

using testing::ElementsAre;

std::vector<std::uint16_t> encoded(const WireForm& form, Number value) {
  std::vector<std::uint16_t> registers(config::registers_of(form.type));
  EXPECT_TRUE(encode(form, value, registers)) << static_cast<double>(value);
  return registers;
}

TEST(Wire, Orders_are_those_of_the_letters) {
  // 123456.789f is 47 F1 20 65 hex: a b c d.
  const float value = 123456.789F;
  EXPECT_THAT(encoded({WireType::Float32, false, false}, static_cast<Number>(value)), ElementsAre(0x47F1, 0x2065));
  EXPECT_THAT(encoded({WireType::Float32, true, false}, static_cast<Number>(value)), ElementsAre(0x2065, 0x47F1));
  EXPECT_THAT(encoded({WireType::Float32, false, true}, static_cast<Number>(value)), ElementsAre(0xF147, 0x6520));
  EXPECT_THAT(encoded({WireType::Float32, true, true}, static_cast<Number>(value)), ElementsAre(0x6520, 0xF147));
}

TEST(Wire, Whole_numbers_of_all_widths) {
  EXPECT_THAT(encoded({WireType::UInt16}, 0x1234), ElementsAre(0x1234));
  EXPECT_THAT(encoded({WireType::UInt16, false, true}, 0x1234), ElementsAre(0x3412));
  EXPECT_THAT(encoded({WireType::Int16}, -2), ElementsAre(0xFFFE));
  EXPECT_THAT(encoded({WireType::Int32}, -2), ElementsAre(0xFFFF, 0xFFFE));
  EXPECT_THAT(encoded({WireType::UInt32}, 0x12345678), ElementsAre(0x1234, 0x5678));
  EXPECT_THAT(encoded({WireType::Int64}, static_cast<Number>(0x123456789ABCDEF0)),
              ElementsAre(0x1234, 0x5678, 0x9ABC, 0xDEF0));
  EXPECT_THAT(encoded({WireType::UInt64, true, false}, static_cast<Number>(0xFEDCBA9876543210)),
              ElementsAre(0x3210, 0x7654, 0xBA98, 0xFEDC));
  EXPECT_THAT(encoded({WireType::Float64}, 1), ElementsAre(0x3FF0, 0, 0, 0));
}

TEST(Wire, Comes_back_as_it_was) {
  constexpr std::array<WireType, 9> kTypes{WireType::Bool,   WireType::Int16,   WireType::UInt16,
                                           WireType::Int32,  WireType::UInt32,  WireType::Int64,
                                           WireType::UInt64, WireType::Float32, WireType::Float64};
  for (const WireType type : kTypes) {
    for (int order = 0; order < 4; ++order) {
      const WireForm form{type, (order & 1) != 0, (order & 2) != 0};
      const Number value = type == WireType::Bool ? 1 : 12345;
      EXPECT_EQ(decode(form, encoded(form, value)), value) << config::name_of(type) << " order " << order;
    }
  }
}

TEST(Wire, Keeps_every_digit_of_64_bits) {
  constexpr auto kLowLimit = std::numeric_limits<std::int64_t>::min();
  constexpr auto kHighLimit = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(decode({WireType::Int64}, encoded({WireType::Int64}, static_cast<Number>(kLowLimit + 1))),
            static_cast<Number>(kLowLimit + 1));
  EXPECT_EQ(decode({WireType::UInt64}, encoded({WireType::UInt64}, static_cast<Number>(kHighLimit))),
            static_cast<Number>(kHighLimit));
}

TEST(Wire, What_does_not_fit_becomes_the_nearest_value) {
  std::array<std::uint16_t, 2> registers{};
  const auto one = std::span(registers).first(1);
  EXPECT_FALSE(encode({WireType::Int16}, 40000, one));
  EXPECT_EQ(registers[0], 0x7FFF);
  EXPECT_FALSE(encode({WireType::UInt16}, -1, one));
  EXPECT_EQ(registers[0], 0);
  EXPECT_TRUE(encode({WireType::Int16}, static_cast<Number>(32767.4), one));
  EXPECT_EQ(registers[0], 0x7FFF);
  EXPECT_FALSE(encode({WireType::Float32}, static_cast<Number>(1e300), registers));
  EXPECT_EQ(decode({WireType::Float32}, registers), static_cast<Number>(std::numeric_limits<float>::max()));
}

TEST(Wire, Rounds_to_the_nearest) {
  EXPECT_THAT(encoded({WireType::Int16}, static_cast<Number>(2.5)), ElementsAre(2));
  EXPECT_THAT(encoded({WireType::Int16}, static_cast<Number>(-2.6)), ElementsAre(0xFFFD));
}

}  // namespace
}  // namespace indurop::io
