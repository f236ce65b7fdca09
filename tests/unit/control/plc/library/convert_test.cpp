// SPDX-License-Identifier: Apache-2.0
// Conversions between numbers: rounding, ends of the range, NaN, times, decimals.

#include <gtest/gtest.h>
#include <indurop/plc/convert.h>

#include <cmath>
#include <limits>

namespace indurop::iec {
namespace {

using std::int16_t;
using std::int32_t;
using std::int64_t;
using std::int8_t;
using std::uint16_t;
using std::uint32_t;
using std::uint64_t;
using std::uint8_t;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(PlcConvert, Reals_round_to_the_nearest_integer_halves_to_the_even_one) {
  struct Row {
    double in;
    int16_t rounded, cut;
  };
  for (const auto& [in, rounded, cut] :
       {Row{0.5, 0, 0}, Row{1.5, 2, 1}, Row{2.5, 2, 2}, Row{3.5, 4, 3}, Row{-0.5, 0, 0}, Row{-1.5, -2, -1},
        Row{-2.5, -2, -2}, Row{0.4999, 0, 0}, Row{1.6, 2, 1}, Row{-1.6, -2, -1}, Row{32767.4, 32767, 32767}}) {
    EXPECT_EQ(to<int16_t>(in), rounded) << in;
    EXPECT_EQ(to<int16_t>(static_cast<float>(in)), rounded) << in;
    EXPECT_EQ(trunc<int16_t>(in), cut) << in;
  }
}

template <class T>
class PlcToInteger : public testing::Test {};
using AllIntegers = testing::Types<int8_t, int16_t, int32_t, int64_t, uint8_t, uint16_t, uint32_t, uint64_t>;
TYPED_TEST_SUITE(PlcToInteger, AllIntegers);

TYPED_TEST(PlcToInteger, Reals_beyond_the_range_give_its_nearest_end) {
  using Limits = std::numeric_limits<TypeParam>;
  for (const double big : {1e30, kInfinity, std::ldexp(1.0, Limits::digits)}) {
    EXPECT_EQ(to<TypeParam>(big), Limits::max()) << big;
    EXPECT_EQ(trunc<TypeParam>(big), Limits::max()) << big;
  }
  for (const double small : {-1e30, -kInfinity}) {
    EXPECT_EQ(to<TypeParam>(small), Limits::min()) << small;
    EXPECT_EQ(trunc<TypeParam>(static_cast<float>(small)), Limits::min()) << small;
  }
  EXPECT_EQ(to<TypeParam>(static_cast<double>(Limits::min())), Limits::min());
  EXPECT_EQ(to<TypeParam>(std::nextafter(std::ldexp(1.0, Limits::digits), 0.0)),
            Limits::digits > 53 ? static_cast<TypeParam>(std::nextafter(std::ldexp(1.0, Limits::digits), 0.0))
                                : Limits::max());
}

TYPED_TEST(PlcToInteger, No_number_is_zero) {
  EXPECT_EQ(to<TypeParam>(std::nan("")), TypeParam{0});
  EXPECT_EQ(trunc<TypeParam>(std::nanf("")), TypeParam{0});
}

TEST(PlcConvert, Integers_keep_their_low_bits) {
  EXPECT_EQ(to<int16_t>(int32_t{65536 + 5}), 5);
  EXPECT_EQ(to<int8_t>(int16_t{200}), -56);
  EXPECT_EQ(to<uint16_t>(int16_t{-1}), 65535);
  EXPECT_EQ(to<int16_t>(uint16_t{65535}), -1);
  EXPECT_EQ(to<int64_t>(int8_t{-1}), -1);
  EXPECT_EQ(to<uint32_t>(int8_t{-1}), 0xFFFFFFFFU);
}

TEST(PlcConvert, Bools_are_zero_and_one_and_anything_else_is_true) {
  EXPECT_EQ(to<int16_t>(true), 1);
  EXPECT_EQ(to<float>(false), 0.0F);
  EXPECT_TRUE(to<bool>(int32_t{0x10000}));
  EXPECT_FALSE(to<bool>(uint8_t{0}));
  EXPECT_TRUE(to<bool>(0.1));
  EXPECT_TRUE(to<bool>(Time{1}));
}

TEST(PlcConvert, Reals_of_two_widths) {
  EXPECT_EQ(to<float>(0.1), 0.1F);
  EXPECT_EQ(to<double>(0.5F), 0.5);
  EXPECT_TRUE(std::isinf(to<float>(1e300)));
  EXPECT_EQ(to<float>(int32_t{16777217}), 16777216.0F);
}

TEST(PlcConvert, Durations_are_milliseconds_and_dates_seconds) {
  EXPECT_EQ(to<int32_t>(Time{1'500 * kMillisecond}), 1500);
  EXPECT_EQ(to<int32_t>(Time{-1'999'999}), -1);
  EXPECT_EQ(to<double>(Time{2'500'000}), 2.5);
  EXPECT_EQ(to<Time>(int16_t{-20}), Time{-20 * kMillisecond});
  EXPECT_EQ(to<Time>(2.5F), Time{2'500'000});
  EXPECT_EQ(to<Time>(uint32_t{4'000'000'000}), Time{4'000'000 * kSecond});
  EXPECT_EQ(to<int16_t>(Time{70'000 * kMillisecond}), static_cast<int16_t>(70'000));
  EXPECT_EQ(to<Time>(std::nan("")), Time{});
  EXPECT_EQ(to<Time>(1e300), Time{std::numeric_limits<int64_t>::max()});
  EXPECT_EQ(to<uint32_t>(DateTime{86'400 * kSecond + 5}), 86'400U);
  EXPECT_EQ(to<DateTime>(uint32_t{60}), DateTime{kMinute});
  EXPECT_EQ(to<uint32_t>(TimeOfDay{kHour}), 3'600'000U);
}

TEST(PlcConvert, Dates_begin_at_midnight_and_times_of_day_end_there) {
  EXPECT_EQ(to<Date>(DateTime{kDay + kHour}), Date{kDay});
  EXPECT_EQ(to<Date>(DateTime{-1}), Date{-kDay});
  EXPECT_EQ(to<TimeOfDay>(DateTime{kDay + kHour}), TimeOfDay{kHour});
  EXPECT_EQ(to<TimeOfDay>(DateTime{-1}), TimeOfDay{kDay - 1});
  EXPECT_EQ(to<DateTime>(Date{kDay}), DateTime{kDay});
  EXPECT_EQ(to<TimeOfDay>(Time{25 * kHour}), TimeOfDay{kHour});
  EXPECT_EQ(to<Date>(uint32_t{86'401}), Date{kDay});
}

TEST(PlcConvert, Decimals_in_bit_strings) {
  EXPECT_EQ(from_bcd<uint16_t>(uint16_t{0x1234}), 1234);
  EXPECT_EQ(from_bcd<uint8_t>(uint8_t{0x99}), 99);
  EXPECT_EQ(from_bcd<uint8_t>(uint8_t{0x1A}), 20);
  EXPECT_EQ(from_bcd<uint64_t>(uint64_t{0x9999'9999'9999'9999}), 9'999'999'999'999'999U);
  EXPECT_EQ(to_bcd<uint16_t>(uint16_t{1234}), 0x1234);
  EXPECT_EQ(to_bcd<uint8_t>(uint8_t{123}), 0x23);
  EXPECT_EQ(to_bcd<uint32_t>(uint8_t{255}), 0x255U);
}

}  // namespace
}  // namespace indurop::iec
