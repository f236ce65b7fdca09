// SPDX-License-Identifier: Apache-2.0
// Fields written one by one, compared with the same value parsed from its text.

#include "core/schema/write_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/core/schema/types.h"

namespace indurop::schema {
namespace {

using Bytes = std::vector<std::uint8_t>;

Type mixed() {
  return structure("mixed_t", {{"b", number(Base::Bool)},
                               {"i8", number(Base::Int8)},
                               {"u8", number(Base::UInt8)},
                               {"i16", number(Base::Int16)},
                               {"u32", number(Base::UInt32)},
                               {"i64", number(Base::Int64)},
                               {"u64", number(Base::UInt64)},
                               {"f", number(Base::Float)},
                               {"d", number(Base::Double)},
                               {"list", number(Base::Int16, {3})},
                               {"label", text(8)}});
}

// All bytes are set before, so that what is written outside of the field shows.
void compare(const std::string& field, const std::string& value, bool written, const Bytes& bytes) {
  const Type type = mixed();
  Bytes expected(type.size(), 1);
  const auto parsed = parse_value(type, "{" + field + ": " + value + "}", expected);
  EXPECT_EQ(written, parsed.ok()) << field << ": " << value << " " << (parsed ? "" : parsed.error().message);
  EXPECT_EQ(bytes, expected) << field << ": " << value;
}

TEST(WriteField, Numbers_are_those_that_a_text_gives) {
  const Type type = mixed();
  for (const char* field : {"b", "i8", "u8", "i16", "u32", "i64", "u64", "f", "d"}) {
    for (const double value : {0.0, 1.0, -1.0, 127.0, 128.0, -128.0, -129.0, 255.0, 256.0, 32767.0, 32768.0,
                               4294967295.0, 4294967296.0, -32769.0, 4503599627370496.0}) {
      Bytes bytes(type.size(), 1);
      const bool written = write_field(type, field, value, bytes);
      compare(field, std::to_string(static_cast<std::int64_t>(value)), written, bytes);
    }
  }
}

TEST(WriteField, Ends_of_64_bits_fractions_and_no_numbers_do_not_fit_into_integers) {
  const Type type = mixed();
  Bytes bytes(type.size(), 1);
  const Bytes before = bytes;
  for (const double value : {0.5, -0.25, std::ldexp(1.0, 64), -std::ldexp(1.0, 64), std::nan(""), HUGE_VAL}) {
    EXPECT_FALSE(write_field(type, "i64", value, bytes)) << value;
    EXPECT_FALSE(write_field(type, "u64", value, bytes)) << value;
    EXPECT_FALSE(write_field(type, "i8", value, bytes)) << value;
  }
  EXPECT_FALSE(write_field(type, "i64", std::ldexp(1.0, 63), bytes));
  EXPECT_FALSE(write_field(type, "f", 1e300, bytes));
  EXPECT_EQ(bytes, before);
  EXPECT_TRUE(write_field(type, "u64", std::ldexp(1.0, 63), bytes));
  EXPECT_TRUE(write_field(type, "i64", -std::ldexp(1.0, 63), bytes));
}

TEST(WriteField, Arrays_and_texts_are_written_whole) {
  const Type type = mixed();
  Bytes bytes(type.size(), 1);
  compare("list", "[3, -2, 7]", write_field(type, "list", std::vector<double>{3, -2, 7}, bytes), bytes);
  bytes.assign(type.size(), 1);
  for (const auto& wrong : {std::vector<double>{1, 2}, {1, 2, 3, 4}, {1, 2, 40000}}) {
    EXPECT_FALSE(write_field(type, "list", wrong, bytes));
  }
  for (const char* label : {"", "seven77", "eight888"}) {
    bytes.assign(type.size(), 1);
    compare("label", "\"" + std::string(label) + "\"", write_field(type, "label", std::string_view(label), bytes),
            bytes);
  }
}

TEST(WriteField, Other_fields_and_other_bytes_are_refused) {
  const Type type = mixed();
  Bytes bytes(type.size(), 1);
  Bytes few(type.size() - 1, 1);
  EXPECT_FALSE(write_field(type, "none", 1.0, bytes));
  EXPECT_FALSE(write_field(type, "list", 1.0, bytes));
  EXPECT_FALSE(write_field(type, "label", 1.0, bytes));
  EXPECT_FALSE(write_field(type, "d", std::string_view("1"), bytes));
  EXPECT_FALSE(write_field(number(Base::Int32), "d", 1.0, bytes));
  EXPECT_FALSE(write_field(type, "label", std::string_view("x"), std::span(few).first(type.size() - 8)));
  EXPECT_EQ(bytes, Bytes(type.size(), 1));
}

}  // namespace
}  // namespace indurop::schema
