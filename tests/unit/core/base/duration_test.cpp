// SPDX-License-Identifier: Apache-2.0
// Durations as text, in both directions.

#include <gmock/gmock.h>

#include <chrono>
#include <random>

#include "config/xml/reader.h"
#include "config/xml/values.h"

namespace indurop::base {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::Optional;

TEST(Duration, Plain_number_is_nanoseconds) {
  EXPECT_THAT(parse_duration("500000"), Optional(Nanos(500'000)));
  EXPECT_THAT(parse_duration("9223372036854775807"), Optional(Nanos::max()));
}

TEST(Duration, Units_and_decimals_are_exact) {
  EXPECT_THAT(parse_duration("100us"), Optional(Nanos(microseconds(100))));
  EXPECT_THAT(parse_duration("100 \xC2\xB5s"), Optional(Nanos(microseconds(100))));
  EXPECT_THAT(parse_duration("100\xCE\xBCs"), Optional(Nanos(microseconds(100))));
  EXPECT_THAT(parse_duration("0.5ms"), Optional(Nanos(microseconds(500))));
  EXPECT_THAT(parse_duration("2s"), Optional(Nanos(seconds(2))));
  EXPECT_THAT(parse_duration("1min"), Optional(Nanos(seconds(60))));
  EXPECT_THAT(parse_duration("1.5h"), Optional(Nanos(seconds(5400))));
  EXPECT_THAT(parse_duration("0.000000001s"), Optional(Nanos(1)));
  EXPECT_THAT(parse_duration("1.500000000000000ms"), Optional(Nanos(microseconds(1500))));
}

TEST(Duration, Frequencies_become_periods) {
  EXPECT_THAT(parse_duration("10kHz"), Optional(Nanos(microseconds(100))));
  EXPECT_THAT(parse_duration("1MHz"), Optional(Nanos(1'000)));
  EXPECT_THAT(parse_duration("0.5Hz"), Optional(Nanos(seconds(2))));
  EXPECT_THAT(parse_duration("30Hz"), Optional(Nanos(33'333'333)));
  EXPECT_THAT(parse_duration("60Hz"), Optional(Nanos(16'666'667)));
}

TEST(Duration, A_plain_number_on_a_command_line_is_seconds) {
  const auto read = [](std::string_view text) { return read_duration(text, true, PlainNumber::Seconds).value; };
  EXPECT_THAT(read("2"), Optional(Nanos(seconds(2))));
  EXPECT_THAT(read("0.5"), Optional(Nanos(milliseconds(500))));
  EXPECT_THAT(read("250ms"), Optional(Nanos(milliseconds(250))));
  EXPECT_THAT(read("1 s"), Optional(Nanos(seconds(1))));
  EXPECT_THAT(read("0"), Optional(Nanos(0)));
  for (const char* text : {"", "s", "-1", "1x", "nan", "inf", "1e300", "2s2", "0.0000000001"}) {
    EXPECT_EQ(read(text), std::nullopt) << text;
  }
  EXPECT_THAT(read_duration("soon", true, PlainNumber::Seconds).problem, HasSubstr("write seconds (2, 0.5)"));
}

TEST(Duration, Every_time_is_exact_to_the_nanosecond) {
  EXPECT_THAT(parse_duration("1.001ms"), Optional(Nanos(1'001'000)));
  std::mt19937_64 random(5);
  for (int round = 0; round < 10'000; ++round) {
    const auto micros = static_cast<std::int64_t>(random() % 100'000'000);
    std::string decimals = std::to_string(micros % 1'000);
    decimals.insert(0, 3 - decimals.size(), '0');
    const std::string text = std::to_string(micros / 1'000) + "." + decimals;
    EXPECT_EQ(read_duration(text + "ms", true).value, Nanos(microseconds(micros))) << text;
    EXPECT_EQ(read_duration(text, true, PlainNumber::Seconds).value, Nanos(milliseconds(micros))) << text;
  }
}

TEST(Duration, Refuses_what_is_none) {
  for (const char* text : {"",
                           " ",
                           "0",
                           "0us",
                           "0.0",
                           "-5",
                           "-1ms",
                           "abc",
                           "5 parsecs",
                           "ms",
                           "1.ms",
                           ".5ms",
                           "1e6",
                           "1,5ms",
                           "1_000",
                           "0x10",
                           "1ms 2",
                           "9223372036854775808",
                           "99999999999999999999",
                           "300000000000s",
                           "0.5",
                           "0.0001us",
                           "1GHz",
                           "0Hz",
                           "99999999999MHz",
                           "1.0000000000000000001s",
                           "nan",
                           "+5"}) {
    EXPECT_FALSE(parse_duration(text).has_value()) << text;
  }
}

TEST(Duration, Says_what_is_wrong) {
  EXPECT_THAT(read_duration("-1ms", false).problem, HasSubstr("negative"));
  EXPECT_THAT(read_duration("5 lightyears", false).problem, HasSubstr("unknown unit 'lightyears'"));
  EXPECT_THAT(read_duration("0.5", false).problem, HasSubstr("whole number of nanoseconds"));
  EXPECT_THAT(read_duration("99999999999999999999", false).problem, HasSubstr("more digits"));
  EXPECT_THAT(read_duration("300000000000s", false).problem, HasSubstr("292 years"));
  EXPECT_THAT(read_duration("0", true).value, Optional(Nanos(0)));
}

TEST(Duration, Shortest_exact_form) {
  EXPECT_EQ(format_duration(microseconds(100)), "100 us");
  EXPECT_EQ(format_duration(milliseconds(1)), "1 ms");
  EXPECT_EQ(format_duration(microseconds(2500)), "2.5 ms");
  EXPECT_EQ(format_duration(Nanos(1'050)), "1.05 us");
  EXPECT_EQ(format_duration(Nanos(1'000'001)), "1000.001 us");
  EXPECT_EQ(format_duration(seconds(2)), "2 s");
  EXPECT_EQ(format_duration(Nanos(0)), "0 ns");
  EXPECT_EQ(format_duration(Nanos(999)), "999 ns");
  EXPECT_EQ(format_duration(Nanos(-1'500)), "-1.5 us");
  EXPECT_EQ(format_duration(Nanos::min()), "-9223372036854775808 ns");
}

TEST(Duration, Printed_form_is_read_back) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 10'000; ++round) {
    const Nanos value(static_cast<std::int64_t>(random() >> (1U + static_cast<unsigned>(round) % 62U)) + 1);
    ASSERT_THAT(parse_duration(format_duration(value)), Optional(value)) << value.count();
  }
  EXPECT_THAT(parse_duration(format_duration(Nanos::max())), Optional(Nanos::max()));
}

}  // namespace
}  // namespace indurop::base
