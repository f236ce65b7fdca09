// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/unit/core/schema/types.h"

namespace indurop::schema {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kUnlimited{-kInfinity, kInfinity};

template <class T>
std::vector<std::uint8_t> bytes_of(std::initializer_list<T> values) {
  std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), std::data(values), bytes.size());
  return bytes;
}

std::string offender(const Range& range, const Type& type, const std::vector<std::uint8_t>& bytes) {
  const auto sut = check_range(range, type, bytes);
  EXPECT_TRUE(sut.ok() || !sut.error().message.empty());
  return sut.ok() ? "" : sut.error().message;
}

TEST(Range, Limits_belong_to_it) {
  const Type type = number(Base::Int32);
  EXPECT_EQ(offender({-5, 5}, type, bytes_of({-5})), "");
  EXPECT_EQ(offender({-5, 5}, type, bytes_of({5})), "");
  EXPECT_EQ(offender({-5, 5}, type, bytes_of({6})), "6 is outside -5..5");
  EXPECT_EQ(offender({-kInfinity, 5}, type, bytes_of({6})), "6 is outside -inf..5");
}

TEST(Range, Names_the_first_element_outside) {
  EXPECT_EQ(offender({0, 1}, number(Base::Double, {2, 2}), bytes_of({0.0, 1.0, 1.5, 3.0})),
            "[1][0]: 1.5 is outside 0..1");
}

TEST(Range, Fields_are_held_to_their_own) {
  Type type = joints_type();
  type.dims = {2};
  type.fields[1].range = Range{-180, 180};
  EXPECT_EQ(offender(kUnlimited, type, bytes_of({1e9, 0.0, 0.0, 0.0, 190.0, 0.0})), "[1].y: 190 is outside -180..180");
  type.dims.clear();
  EXPECT_EQ(offender(kUnlimited, type, bytes_of({1e9, 190.0, 0.0})), "y: 190 is outside -180..180");
  EXPECT_EQ(offender({0, 1}, type, bytes_of({1e9, 90.0, 0.0})), "x: 1000000000 is outside 0..1");
}

TEST(Range, Sixty_four_bit_integers_are_compared_exactly) {
  const double two_to_63 = 9223372036854775808.0;
  EXPECT_EQ(offender({0, two_to_63}, number(Base::UInt64), bytes_of({std::uint64_t{1} << 63U})), "");
  EXPECT_EQ(offender({0, two_to_63}, number(Base::UInt64), bytes_of({(std::uint64_t{1} << 63U) + 1})),
            "9223372036854775809 is outside 0..9.223372036854776e+18");
}

TEST(Range, NaN_is_outside_every_range_but_the_unlimited) {
  EXPECT_NE(offender({0, 1}, number(Base::Double), bytes_of({std::nan("")})), "");
  EXPECT_EQ(offender(kUnlimited, number(Base::Double), bytes_of({std::nan("")})), "");
}

TEST(Range, Char_is_read_as_its_range_was_meant) {
  const std::vector<std::uint8_t> byte{200};
  EXPECT_EQ(offender({0, 255}, number(Base::Char), byte), "");
  EXPECT_EQ(offender({-100, 100}, number(Base::Char), byte), "");
  EXPECT_EQ(offender({0, 100}, number(Base::Char), byte), "200 is outside 0..100");
}

TEST(Range, Text_bool_and_enum_have_none_and_short_bytes_are_refused) {
  EXPECT_EQ(offender({5, 6}, text(4), std::vector<std::uint8_t>(4)), "");
  EXPECT_EQ(offender({5, 6}, number(Base::Bool), {0}), "");
  EXPECT_EQ(check_range({0, 1}, number(Base::Double), {}).error().code, Errc::InvalidArgument);
}

}  // namespace
}  // namespace indurop::schema
