// SPDX-License-Identifier: Apache-2.0
// Values as text, there and back.

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/schema/leaf.h"
#include "tests/unit/core/schema/types.h"

namespace indurop::schema {
namespace {

using testing::HasSubstr;

using Bytes = std::vector<std::uint8_t>;

template <class T>
Bytes value_bytes(std::initializer_list<T> values) {
  Bytes bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), std::data(values), bytes.size());
  return bytes;
}

struct Parsed {
  Errc code = Errc::Ok;
  std::string message;
  Bytes bytes;
};
Parsed parsed(const Type& type, std::string_view text, std::uint8_t before = 0) {
  Parsed out;
  out.bytes.assign(type.size(), before);
  const auto sut = parse_value(type, text, out.bytes);
  if (!sut.ok()) {
    out.code = sut.error().code;
    out.message = sut.error().message;
    EXPECT_NE(out.code, Errc::Ok);
    EXPECT_NE(out.message, "");
    EXPECT_EQ(out.bytes, Bytes(type.size(), before)) << "a failed parse changed bytes";
  }
  return out;
}

void expect_round_trip(const Type& type, const Bytes& bytes, const std::string& text) {
  EXPECT_EQ(format_value(type, bytes), text);
  const Parsed back = parsed(type, text, 0xEE);
  EXPECT_EQ(back.code, Errc::Ok) << back.message;
  EXPECT_EQ(back.bytes, bytes) << text;
}

template <class T>
void expect_extremes(Base base) {
  using Limits = std::numeric_limits<T>;
  expect_round_trip(number(base), value_bytes<T>({Limits::min()}), std::to_string(Limits::min()));
  expect_round_trip(number(base), value_bytes<T>({Limits::max()}), std::to_string(Limits::max()));
}

TEST(Value, Integers_of_every_size_round_trip_at_their_limits) {
  expect_extremes<std::int8_t>(Base::Int8);
  expect_extremes<std::uint8_t>(Base::UInt8);
  expect_extremes<std::int16_t>(Base::Int16);
  expect_extremes<std::uint16_t>(Base::UInt16);
  expect_extremes<std::int32_t>(Base::Int32);
  expect_extremes<std::uint32_t>(Base::UInt32);
  expect_extremes<std::int64_t>(Base::Int64);
  expect_extremes<std::uint64_t>(Base::UInt64);
}

template <class T>
void expect_number(Base base) {
  const T lowest = std::numeric_limits<T>::lowest();
  const T highest = std::numeric_limits<T>::max();
  EXPECT_EQ(as_number<long double>(base, value_bytes<T>({lowest}).data()), static_cast<long double>(lowest));
  EXPECT_EQ(as_number<long double>(base, value_bytes<T>({highest}).data()), static_cast<long double>(highest));
  EXPECT_EQ(as_number<double>(base, value_bytes<T>({T{7}}).data()), 7.0);
}

TEST(Value, Numbers_of_every_type_are_read_out_of_bytes) {
  expect_number<std::int8_t>(Base::Int8);
  expect_number<std::uint8_t>(Base::UInt8);
  expect_number<std::int16_t>(Base::Int16);
  expect_number<std::uint16_t>(Base::UInt16);
  expect_number<std::int32_t>(Base::Int32);
  expect_number<std::uint32_t>(Base::UInt32);
  expect_number<std::int64_t>(Base::Int64);
  expect_number<std::uint64_t>(Base::UInt64);
  expect_number<float>(Base::Float);
  expect_number<double>(Base::Double);
  expect_number<std::uint8_t>(Base::Char);
  expect_number<std::int32_t>(Base::Enum);
  EXPECT_EQ(as_number<double>(Base::Bool, Bytes{0}.data()), 0.0);
  EXPECT_EQ(as_number<double>(Base::Bool, Bytes{2}.data()), 1.0);
  EXPECT_FALSE(as_number<double>(Base::Text, Bytes{'7'}.data()));
  EXPECT_FALSE(as_number<double>(Base::Struct, Bytes{7}.data()));
}

TEST(Value, Integers_beyond_their_type_are_out_of_range) {
  for (const auto& [base, text] : std::vector<std::pair<Base, const char*>>{{Base::Int8, "128"},
                                                                            {Base::Int8, "-129"},
                                                                            {Base::UInt8, "256"},
                                                                            {Base::UInt8, "-1"},
                                                                            {Base::Int64, "9223372036854775808"},
                                                                            {Base::Int64, "-9223372036854775809"},
                                                                            {Base::UInt64, "18446744073709551616"},
                                                                            {Base::UInt32, "-1"},
                                                                            {Base::Int32, "0xFFFFFFFF"}}) {
    EXPECT_EQ(parsed(number(base), text).code, Errc::OutOfRange) << text;
  }
  EXPECT_EQ(parsed(number(Base::UInt8), "300").message, "300 does not fit uint8_t (0 to 255)");
  for (const char* text : {"", "abc", "1.5", "1e3", "1 2", "--1", "+-1", "0x", "0xG", "1,", "[1]", "1]", "\"1\""}) {
    EXPECT_EQ(parsed(number(Base::Int32), text).code, Errc::InvalidArgument) << text;
  }
}

TEST(Value, Integers_may_be_hex_or_signed) {
  EXPECT_EQ(parsed(number(Base::Int32), " 0x10 ").bytes, value_bytes<std::int32_t>({16}));
  EXPECT_EQ(parsed(number(Base::Int32), "-0X10").bytes, value_bytes<std::int32_t>({-16}));
  EXPECT_EQ(parsed(number(Base::Int32), "+7").bytes, value_bytes<std::int32_t>({7}));
  EXPECT_EQ(parsed(number(Base::UInt32), "0xFFFFFFFF").bytes, value_bytes<std::uint32_t>({UINT32_MAX}));
  EXPECT_EQ(parsed(number(Base::UInt8), "-0").bytes, Bytes{0});
}

TEST(Value, Reals_take_their_shortest_form) {
  expect_round_trip(number(Base::Double), value_bytes({0.1}), "0.1");
  expect_round_trip(number(Base::Double), value_bytes({1.0}), "1");
  expect_round_trip(number(Base::Double), value_bytes({-0.0}), "-0");
  expect_round_trip(number(Base::Float), value_bytes({0.1F}), "0.1");
  expect_round_trip(number(Base::Float), value_bytes({16777216.0F}), "16777216");
  for (const double value : {std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
                             std::numeric_limits<double>::denorm_min(), 1.0 / 3, 1e22, -123456.789}) {
    expect_round_trip(number(Base::Double), value_bytes({value}),
                      format_value(number(Base::Double), value_bytes({value})));
  }
  for (const float value : {std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min(), 1.0F / 3}) {
    expect_round_trip(number(Base::Float), value_bytes({value}),
                      format_value(number(Base::Float), value_bytes({value})));
  }
  EXPECT_EQ(parsed(number(Base::Double), "1e3").bytes, value_bytes({1000.0}));
  EXPECT_EQ(parsed(number(Base::Double), "+.5").bytes, value_bytes({0.5}));
  EXPECT_EQ(parsed(number(Base::Double), "0x10").bytes, value_bytes({16.0}));
  EXPECT_EQ(parsed(number(Base::Float), "1e39").code, Errc::OutOfRange);
  EXPECT_EQ(parsed(number(Base::Double), "1e999").code, Errc::OutOfRange);
  for (const char* text : {"", "one", "1,5", "1.2.3", "0x1p3", "+-1", "++1", "- 1"}) {
    EXPECT_EQ(parsed(number(Base::Double), text).code, Errc::InvalidArgument) << text;
  }
}

TEST(Value, Infinities_and_NaN_round_trip) {
  const double infinity = std::numeric_limits<double>::infinity();
  expect_round_trip(number(Base::Double), value_bytes({infinity}), "inf");
  expect_round_trip(number(Base::Double), value_bytes({-infinity}), "-inf");
  expect_round_trip(number(Base::Float), value_bytes({-std::numeric_limits<float>::infinity()}), "-inf");
  const Parsed nan = parsed(number(Base::Double), "nan");
  ASSERT_EQ(nan.code, Errc::Ok);
  EXPECT_EQ(format_value(number(Base::Double), nan.bytes), "nan");
  EXPECT_EQ(format_value(number(Base::Float), value_bytes({-std::numeric_limits<float>::quiet_NaN()})), "nan");
}

TEST(Value, Bool_is_a_word_or_a_digit) {
  expect_round_trip(number(Base::Bool), {1}, "true");
  expect_round_trip(number(Base::Bool), {0}, "false");
  EXPECT_EQ(parsed(number(Base::Bool), "1").bytes, Bytes{1});
  EXPECT_EQ(parsed(number(Base::Bool), "0").bytes, Bytes{0});
  EXPECT_EQ(format_value(number(Base::Bool), Bytes{0x80}), "true");
  EXPECT_EQ(parsed(number(Base::Bool), "[true]").message, "'[true]' is not a bool; write true, false, 1 or 0");
  EXPECT_EQ(parsed(number(Base::Bool), "2").message, "'2' is not a bool; write true, false, 1 or 0");
}

TEST(Value, Every_char_round_trips) {
  const Type type = number(Base::Char);
  for (unsigned c = 0; c < 256; ++c) {
    const Bytes byte{static_cast<std::uint8_t>(c)};
    EXPECT_EQ(parsed(type, format_value(type, byte), 0x55).bytes, byte) << c;
    EXPECT_EQ(parsed(type, value_to_json(type, byte), 0x55).bytes, byte) << c;
  }
  EXPECT_EQ(format_value(type, Bytes{'A'}), "'A'");
  EXPECT_EQ(format_value(type, Bytes{'\''}), "'\\''");
  EXPECT_EQ(format_value(type, Bytes{0}), "'\\x00'");
  EXPECT_EQ(parsed(type, "A").bytes, Bytes{'A'});
  EXPECT_EQ(parsed(type, "-").bytes, Bytes{'-'});
  EXPECT_EQ(parsed(type, "5").bytes, Bytes{5});
  EXPECT_EQ(parsed(type, "-1").bytes, Bytes{255});
  EXPECT_EQ(parsed(type, "256").code, Errc::OutOfRange);
  EXPECT_EQ(parsed(type, "'\\u0100'").code, Errc::OutOfRange);
  for (const char* text : {"", "''", "'ab'", "'a", "ab", "'\\q'", "'\\x4'"}) {
    EXPECT_EQ(parsed(type, text).code, Errc::InvalidArgument) << text;
  }
}

Bytes text_bytes(std::string_view value, std::size_t size) {
  Bytes bytes(value.begin(), value.end());
  bytes.resize(size, 0);
  return bytes;
}

TEST(Value, Text_round_trips_with_quotes_and_escapes) {
  const Type type = text(32);
  expect_round_trip(type, text_bytes("", 32), "\"\"");
  expect_round_trip(type, text_bytes("home", 32), "\"home\"");
  expect_round_trip(type, text_bytes("say \"hi\" \\ 'you'", 32), R"("say \"hi\" \\ 'you'")");
  expect_round_trip(type, text_bytes("a\nb\tc\rd\x1b\x7f", 32), R"("a\nb\tc\rd\x1b\x7f")");
  expect_round_trip(type,
                    text_bytes("\xC2\xB0"
                               "C \xE2\x82\xAC \xF0\x9F\xA4\x96",
                               32),
                    "\"\xC2\xB0"
                    "C \xE2\x82\xAC \xF0\x9F\xA4\x96\"");
  expect_round_trip(type, text_bytes("\xFF\xC0\xAF\xED\xA0\x80\xE2\x82", 32), R"("\xff\xc0\xaf\xed\xa0\x80\xe2\x82")");
}

TEST(Value, Text_may_come_without_quotes_when_it_is_all) {
  EXPECT_EQ(parsed(text(16), "go home").bytes, text_bytes("go home", 16));
  EXPECT_EQ(parsed(text(16), "a,b]").bytes, text_bytes("a,b]", 16));
  EXPECT_EQ(parsed(text(16), "'x'").bytes, text_bytes("x", 16));
  EXPECT_EQ(parsed(text(16), "").bytes, text_bytes("", 16));
  EXPECT_EQ(parsed(text(16), R"("\u00b0\u20ac\/")").bytes, text_bytes("\xC2\xB0\xE2\x82\xAC/", 16));
}

TEST(Value, Text_that_does_not_fit_or_end_is_refused) {
  EXPECT_EQ(parsed(text(4), "abc").code, Errc::Ok);
  EXPECT_EQ(parsed(text(4), "abcd").code, Errc::OutOfRange);
  EXPECT_EQ(parsed(text(4), "abcd").message, "4 bytes of text do not fit char[4], which holds 3");
  for (const char* value :
       {"\"abc", "\"", "\"a\" b", "\"a\\", "\"\\q\"", "\"\\x1\"", "\"\\xg0\"", "\"\\0\"", "\"\\u00\""}) {
    EXPECT_EQ(parsed(text(16), value).code, Errc::InvalidArgument) << value;
  }
}

TEST(Value, Text_without_its_NUL_ends_with_the_array) {
  EXPECT_EQ(format_value(text(4), text_bytes("abcd", 4)), "\"abcd\"");
  EXPECT_EQ(format_value(text(4), text_bytes(std::string_view("a\0cd", 4), 4)), "\"a\"");
}

TEST(Value, Enums_go_by_name_or_number) {
  const Type type = mode_type();
  expect_round_trip(type, value_bytes<std::int32_t>({1}), "Manual");
  EXPECT_EQ(parsed(type, "2").bytes, value_bytes<std::int32_t>({2}));
  EXPECT_EQ(parsed(type, "Mode::Auto").bytes, value_bytes<std::int32_t>({2}));
  EXPECT_EQ(parsed(type, "\"Auto\"").bytes, value_bytes<std::int32_t>({2}));
  EXPECT_EQ(format_value(type, value_bytes<std::int32_t>({-7})), "-7");
  EXPECT_EQ(parsed(type, "7").code, Errc::OutOfRange);
  EXPECT_EQ(parsed(type, "auto").message,
            "'auto' is not a value of knu::Robot::Mode; it has Off = 0, Manual = 1, Auto = 2");
  const Type negative = enumeration("e", {{"Low", INT32_MIN}, {"High", INT32_MAX}});
  EXPECT_EQ(parsed(negative, "-2147483648").bytes, value_bytes<std::int32_t>({INT32_MIN}));
  EXPECT_EQ(parsed(negative, "99999999999999999999").code, Errc::InvalidArgument);
}

TEST(Value, Arrays_of_arrays_round_trip) {
  const Type type = number(Base::Int16, {2, 3});
  expect_round_trip(type, value_bytes<std::int16_t>({1, 2, 3, -4, -5, -6}), "[[1, 2, 3], [-4, -5, -6]]");
  EXPECT_EQ(parsed(type, "[[1,2,3],[4,5,6]]").code, Errc::Ok);
  EXPECT_EQ(parsed(type, "[[1,2],[4,5,6]]").message, "[0]: 2 values where there must be 3 (column 6)");
  EXPECT_EQ(parsed(type, "[[1,2,3,4],[4,5,6]]").message, "[0]: more than 3 values (column 8)");
  EXPECT_EQ(parsed(type, "[[1,2,3],[4,x,6]]").message,
            "[1][1]: 'x' is not a whole number; int16_t takes -32768 to 32767");
  for (const char* value : {"", "[", "[[", "[[1,2,3],[4,5,6]", "[[1,2,3],[4,5,6]]]", "[1,2,3,4,5,6]",
                            "[[1,2,3] [4,5,6]]", "[[1,2,3,],[4,5,6]]", "5", "[]"}) {
    EXPECT_EQ(parsed(type, value).code, Errc::InvalidArgument) << value;
  }
  expect_round_trip(text(4, {2}), text_bytes(std::string_view("ab\0\0c\0\0\0", 8), 8), R"(["ab", "c"])");
}

Type robot_type() {
  const Type point = structure("point_t", {{"x", number(Base::Double)}, {"y", number(Base::Double)}});
  Type points = point;
  points.dims = {2};
  return structure("robot_t",
                   {{"on", number(Base::Bool)}, {"mode", mode_type()}, {"points", points}, {"name", text(8)}});
}

TEST(Value, Nested_structs_round_trip) {
  const Type type = robot_type();
  const std::string value = R"({on: true, mode: Auto, points: [{x: 1.5, y: -2}, {x: 0, y: inf}], name: "r2"})";
  const Parsed sut = parsed(type, value);
  ASSERT_EQ(sut.code, Errc::Ok) << sut.message;
  expect_round_trip(structure("s", {{"a", number(Base::Int32)}, {"b", number(Base::UInt32)}}), value_bytes({1, 2}),
                    "{a: 1, b: 2}");
  EXPECT_EQ(format_value(type, sut.bytes), value);
}

TEST(Value, Fields_may_come_in_any_order_quoted_or_be_left_out) {
  const Type type = structure("s", {{"a", number(Base::Int32)}, {"b", number(Base::Int32)}});
  EXPECT_EQ(parsed(type, "{\"b\": 2, a:1}").bytes, value_bytes({1, 2}));
  EXPECT_EQ(parsed(type, "{b:2}", 0xFF).bytes, value_bytes({-1, 2}));
  EXPECT_EQ(parsed(type, "{ }", 0xFF).bytes, value_bytes({-1, -1}));
  for (const char* value : {"{", "{a", "{a:", "{a:1", "{a:1,", "{a:1,}", "{a 1}", "{a:1 b:2}", "{:1}", "{a:1,a:2}",
                            "[1,2]", "1", "{a:1}}", "{\"a:1}"}) {
    EXPECT_EQ(parsed(type, value).code, Errc::InvalidArgument) << value;
  }
  EXPECT_THAT(parsed(robot_type(), "{mdoe: 1}").message,
              HasSubstr("robot_t has no field 'mdoe'; did you mean 'mode'?"));
  EXPECT_THAT(parsed(robot_type(), "{points: [{x: a}]}").message, HasSubstr("points[0].x: 'a' is not a number"));
}

// JSON that is no word: an object where a number must be, for example.
TEST(Value, What_is_no_word_is_shown_as_it_is_written) {
  EXPECT_EQ(parsed(number(Base::Int64), R"({"a":1})").message,
            R"('{"a":1}' is not a whole number; int64_t takes -9223372036854775808 to 9223372036854775807)");
  EXPECT_EQ(parsed(number(Base::Double), R"({"x":1})").message,
            R"('{"x":1}' is not a number; write it like 2, 0.5 or 1e-3)");
  EXPECT_THAT(parsed(mode_type(), "[1]").message, HasSubstr("'[1]' is not a value of"));
  EXPECT_THAT(parsed(number(Base::Char), "{}").message, HasSubstr("'{}' is not a char"));
  EXPECT_THAT(parsed(number(Base::Int32, {2}), "[1, {a: 2}]").message, HasSubstr("[1]: '{a: 2}]' is not a whole"));
}

TEST(Value, Every_truncation_of_a_value_is_refused) {
  const std::string value = R"({on: true, mode: Auto, points: [{x: 1.5, y: -2}, {x: 0, y: inf}], name: "r2\x41"})";
  for (std::size_t length = 0; length < value.size(); ++length) {
    EXPECT_NE(parsed(robot_type(), std::string_view(value).substr(0, length)).code, Errc::Ok) << length;
  }
}

TEST(Value, Json_is_strict_and_can_be_parsed_back) {
  const Parsed sut =
      parsed(robot_type(), R"({on: true, mode: Auto, points: [{x: 1.5, y: -2}, {x: 0, y: 1e300}], name: 'r"2'})");
  ASSERT_EQ(sut.code, Errc::Ok) << sut.message;
  const std::string json = value_to_json(robot_type(), sut.bytes);
  EXPECT_EQ(json, R"({"on":true,"mode":"Auto","points":[{"x":1.5,"y":-2},{"x":0,"y":1e+300}],"name":"r\"2"})");
  EXPECT_EQ(parsed(robot_type(), json).bytes, sut.bytes);
  EXPECT_EQ(value_to_json(number(Base::Double, {3}),
                          value_bytes({std::nan(""), std::numeric_limits<double>::infinity(), 1.0})),
            "[null,null,1]");
  EXPECT_EQ(value_to_json(text(4), Bytes{0xFF, 0x01, 'a', 0}), R"("\ufffd\u0001a")");
  EXPECT_EQ(value_to_json(number(Base::Char), Bytes{0xE9}), R"("\u00e9")");
}

TEST(Value, Too_few_bytes_give_no_text_and_no_parse) {
  const Type type = number(Base::Double);
  EXPECT_EQ(format_value(type, Bytes(7)), "");
  EXPECT_EQ(value_to_json(type, Bytes(7)), "null");
  Bytes small(7);
  EXPECT_EQ(parse_value(type, "1", small).error().code, Errc::InvalidArgument);
}

}  // namespace
}  // namespace indurop::schema
