// SPDX-License-Identifier: Apache-2.0
// Values to text and back: forms, ends of the ranges, texts that are no values, and round trips.

#include <gtest/gtest.h>
#include <indurop/plc/text_read.h>
#include <indurop/plc/text_write.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace indurop::iec {
namespace {

using std::int16_t;
using std::int64_t;
using std::int8_t;
using std::uint64_t;
using std::uint8_t;

constexpr int64_t kMinLong = std::numeric_limits<int64_t>::min();
constexpr int64_t kMaxLong = std::numeric_limits<int64_t>::max();

template <class T>
T read(const char* text) {
  return to<T>(String<80>(text));
}

TEST(PlcToString, Bools_and_integers) {
  EXPECT_EQ(to_string(true), "TRUE");
  EXPECT_EQ(to_string(false), "FALSE");
  EXPECT_EQ(to_string(int8_t{-128}), "-128");
  EXPECT_EQ(to_string(uint8_t{255}), "255");
  EXPECT_EQ(to_string(kMinLong), "-9223372036854775808");
  EXPECT_EQ(to_string(~uint64_t{0}), "18446744073709551615");
}

TEST(PlcToString, Reals_are_shortest_and_have_a_point) {
  EXPECT_EQ(to_string(1.0), "1.0");
  EXPECT_EQ(to_string(0.1F), "0.1");
  EXPECT_EQ(to_string(-2.5), "-2.5");
  EXPECT_EQ(to_string(1e30), "1.0e+30");
  EXPECT_EQ(to_string(1.25e-9), "1.25e-09");
  EXPECT_EQ(to_string(std::nan("")), "NaN");
  EXPECT_EQ(to_string(-std::numeric_limits<float>::infinity()), "-INF");
}

TEST(PlcToString, Durations_name_the_units_that_are_not_zero) {
  EXPECT_EQ(to_string(Time{}), "T#0s");
  EXPECT_EQ(to_string(Time{90 * kSecond}), "T#1m30s");
  EXPECT_EQ(to_string(Time{-1'500 * kMillisecond}), "T#-1s500ms");
  EXPECT_EQ(to_string(Time{kDay + 2 * kHour + 3 * kMinute + 4 * kSecond + 5'006'007}), "T#1d2h3m4s5ms6us7ns");
  EXPECT_EQ(to_string(Time{kMinLong}), "T#-106751d23h47m16s854ms775us808ns");
}

TEST(PlcToString, Dates) {
  EXPECT_EQ(to_string(Date{}), "D#1970-01-01");
  EXPECT_EQ(to_string(concat_date(2024, 2, 29)), "D#2024-02-29");
  EXPECT_EQ(to_string(TimeOfDay{12 * kHour + 34 * kMinute + 56 * kSecond}), "TOD#12:34:56");
  EXPECT_EQ(to_string(TimeOfDay{500 * kMillisecond}), "TOD#00:00:00.500");
  EXPECT_EQ(to_string(TimeOfDay{1}), "TOD#00:00:00.000000001");
  EXPECT_EQ(to_string(DateTime{-1'000}), "DT#1969-12-31-23:59:59.999999");
  EXPECT_EQ(to_string(DateTime{kMinLong}), "DT#1677-09-21-00:12:43.145224192");
  EXPECT_EQ(to_string(DateTime{kMaxLong}), "DT#2262-04-11-23:47:16.854775807");
}

TEST(PlcFromString, Integers) {
  struct Row {
    const char* text;
    int16_t value;
  };
  for (const auto& [text, value] :
       {Row{"42", 42}, Row{"  -42", -42}, Row{"+7", 7}, Row{"1_000", 1000}, Row{"16#7F", 127}, Row{"2#1010_1010", 170},
        Row{"8#17", 15}, Row{"-16#10", -16}, Row{"12abc", 12}, Row{"abc", 0}, Row{"", 0}, Row{"-", 0}, Row{"1.9", 1},
        Row{"99999", 32767}, Row{"-99999", -32768}, Row{"-32768", -32768}, Row{"99999999999999999999999", 32767}}) {
    EXPECT_EQ(read<int16_t>(text), value) << text;
  }
  EXPECT_EQ(read<uint8_t>("-1"), 0);
  EXPECT_EQ(read<uint8_t>("256"), 255);
  EXPECT_EQ(read<uint64_t>("18446744073709551615"), ~uint64_t{0});
  EXPECT_EQ(read<uint64_t>("16#FFFF_FFFF_FFFF_FFFF"), ~uint64_t{0});
  EXPECT_EQ(read<int64_t>("-9223372036854775808"), kMinLong);
}

TEST(PlcFromString, Reals) {
  EXPECT_EQ(read<double>("1.5"), 1.5);
  EXPECT_EQ(read<double>(" +1_000.25"), 1000.25);
  EXPECT_EQ(read<double>("-1.0E+3xyz"), -1000.0);
  EXPECT_EQ(read<float>("5"), 5.0F);
  EXPECT_EQ(read<double>("text"), 0.0);
  EXPECT_EQ(read<double>(""), 0.0);
  EXPECT_EQ(read<float>("1e300"), std::numeric_limits<float>::max());
  EXPECT_EQ(read<float>("-1e300"), std::numeric_limits<float>::lowest());
  EXPECT_EQ(read<float>("1e-300"), 0.0F);
}

TEST(PlcFromString, Bools) {
  EXPECT_TRUE(read<bool>("TRUE"));
  EXPECT_TRUE(read<bool>("true"));
  EXPECT_TRUE(read<bool>("1"));
  EXPECT_FALSE(read<bool>("FALSE"));
  EXPECT_FALSE(read<bool>("0"));
  EXPECT_FALSE(read<bool>(""));
}

TEST(PlcFromString, Durations) {
  struct Row {
    const char* text;
    int64_t ns;
  };
  for (const auto& [text, ns] :
       {Row{"T#1m30s", 90 * kSecond}, Row{"1m30s", 90 * kSecond}, Row{"TIME#1.5h", 90 * kMinute},
        Row{"t#-5ms", -5 * kMillisecond}, Row{"T#1d_2h", 26 * kHour}, Row{"LTIME#7ns", 7}, Row{"T#250us", 250'000},
        Row{"T#100m", 100 * kMinute}, Row{"", 0}, Row{"T#", 0}, Row{"5", 0}, Row{"nonsense", 0}}) {
    EXPECT_EQ(read<Time>(text), Time{ns}) << text;
  }
}

TEST(PlcFromString, Dates) {
  EXPECT_EQ(read<Date>("D#2024-02-29"), concat_date(2024, 2, 29));
  EXPECT_EQ(read<Date>("2024-02-29"), concat_date(2024, 2, 29));
  EXPECT_EQ(read<Date>("tomorrow"), Date{});
  EXPECT_EQ(read<TimeOfDay>("TOD#12:34:56.5"), TimeOfDay{12 * kHour + 34 * kMinute + 56 * kSecond + kSecond / 2});
  EXPECT_EQ(read<TimeOfDay>("TIME_OF_DAY#06:30"), TimeOfDay{6 * kHour + 30 * kMinute});
  EXPECT_EQ(read<DateTime>("DT#1970-01-02-00:00:01"), DateTime{kDay + kSecond});
}

TEST(PlcFromString, Any_text_is_read_without_harm) {
  std::mt19937 random(7);
  const std::string characters = "0123456789#:-+._eETtDdmsh xX\xFF";
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (std::size_t length = random() % 24; length > 0; --length) {
      text += characters[random() % characters.size()];
    }
    const String<24> sut(text);
    const auto number = to<std::int64_t>(sut);
    ASSERT_EQ(to<int8_t>(sut), std::clamp<std::int64_t>(number, -128, 127)) << text;
    static_cast<void>(to<double>(sut));
    static_cast<void>(to<Time>(sut));
    ASSERT_EQ(to<Date>(sut).ns % kDay, 0) << text;
    ASSERT_TRUE(to<TimeOfDay>(sut).ns >= 0 && to<TimeOfDay>(sut).ns < kDay) << text;
    static_cast<void>(to<DateTime>(sut));
  }
}

TEST(PlcFromString, Every_text_written_reads_back_as_the_value) {
  for (const double value : {0.1, -1.0 / 3, 1e300, 5e-324, 123456789.0, -0.0}) {
    EXPECT_EQ(to<double>(to_string(value)), value);
    EXPECT_EQ(to<float>(to_string(static_cast<float>(value / 1e270))), static_cast<float>(value / 1e270));
  }
  for (const int64_t ns :
       {int64_t{0}, int64_t{1}, int64_t{-1}, kMaxLong, kMinLong + kDay, int64_t{1'700'000'000'123'456'789}}) {
    EXPECT_EQ(to<int64_t>(to_string(ns)), ns);
    EXPECT_EQ(to<Time>(to_string(Time{ns})), Time{ns});
    EXPECT_EQ(to<DateTime>(to_string(DateTime{ns})), DateTime{ns});
    EXPECT_EQ(to<Date>(to_string(to<Date>(DateTime{ns}))), to<Date>(DateTime{ns}));
    EXPECT_EQ(to<TimeOfDay>(to_string(to<TimeOfDay>(DateTime{ns}))), to<TimeOfDay>(DateTime{ns}));
  }
}

}  // namespace
}  // namespace indurop::iec
