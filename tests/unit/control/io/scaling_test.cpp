// SPDX-License-Identifier: Apache-2.0
// Between the device's numbers and the bytes of variables.
#include "control/io/scaling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace indurop::io {
namespace {

using schema::Base;

template <class T>
T as(std::uint64_t bits) {
  T value{};
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

TEST(Scaling, Is_number_times_scale_plus_offset) {
  std::uint64_t bits = 0;
  ASSERT_TRUE(to_variable({Base::Double, 0.1, -20}, 1000, bits));
  EXPECT_DOUBLE_EQ(as<double>(bits), 80);
  EXPECT_NEAR(static_cast<double>(from_variable({Base::Double, 0.1, -20}, bits)), 1000, 1e-9);
}

TEST(Scaling, Saturates_and_says_so) {
  std::uint64_t bits = 0;
  EXPECT_FALSE(to_variable({Base::Int8, 1, 0}, 200, bits));
  EXPECT_EQ(as<std::int8_t>(bits), 127);
  EXPECT_FALSE(to_variable({Base::UInt16, 1, 0}, -5, bits));
  EXPECT_EQ(as<std::uint16_t>(bits), 0);
  EXPECT_FALSE(to_variable({Base::Float, 1, 0}, static_cast<Number>(-1e300), bits));
  EXPECT_EQ(as<float>(bits), -std::numeric_limits<float>::max());
}

TEST(Scaling, Not_a_number_leaves_a_whole_number_alone) {
  std::uint64_t bits = 0;
  ASSERT_TRUE(to_variable({Base::Int16, 1, 0}, 7, bits));
  EXPECT_FALSE(to_variable({Base::Int16, 1, 0}, std::numeric_limits<Number>::quiet_NaN(), bits));
  EXPECT_EQ(as<std::int16_t>(bits), 7);
}

TEST(Scaling, Bool_is_whatever_is_not_zero) {
  std::uint64_t bits = 0;
  ASSERT_TRUE(to_variable({Base::Bool, 1, 0}, 300, bits));
  EXPECT_EQ(as<std::uint8_t>(bits), 1);
  EXPECT_EQ(from_variable({Base::Bool, 1, 0}, bits), 1);
}

TEST(Scaling, Bytes_behind_a_small_value_are_zero) {
  std::uint64_t bits = ~std::uint64_t{0};
  ASSERT_TRUE(to_variable(Base::UInt8, 5, bits));
  EXPECT_EQ(bits, 5U);
}

TEST(Scaling, Keeps_every_digit_of_64_bits) {
  constexpr auto kBig = std::numeric_limits<std::int64_t>::max() - 1;
  std::uint64_t bits = 0;
  ASSERT_TRUE(to_variable({Base::Int64, 1, 0}, static_cast<Number>(kBig), bits));
  EXPECT_EQ(as<std::int64_t>(bits), kBig);
}

}  // namespace
}  // namespace indurop::io
