// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/library/number.h"

#include <gmock/gmock.h>

#include <random>

namespace indurop::fmi {
namespace {

// The yardstick: long double holds every number of up to 64 bits exactly on this machine.
template <class To, class From>
void expect_exact(From value) {
  static_assert(std::numeric_limits<long double>::digits >= 64);
  const auto wide = static_cast<long double>(value);
  const bool fits = wide >= static_cast<long double>(std::numeric_limits<To>::min()) &&
                    wide <= static_cast<long double>(std::numeric_limits<To>::max()) && std::floor(wide) == wide;
  const auto result = exactly<To>(value);
  ASSERT_EQ(result.has_value(), fits) << static_cast<double>(value);
  if (result) {
    ASSERT_EQ(static_cast<long double>(*result), wide);
  }
}

template <class From>
void expect_exact_in_all(From value) {
  expect_exact<std::int8_t>(value);
  expect_exact<std::uint8_t>(value);
  expect_exact<std::int16_t>(value);
  expect_exact<std::uint16_t>(value);
  expect_exact<std::int32_t>(value);
  expect_exact<std::uint32_t>(value);
  expect_exact<std::int64_t>(value);
  expect_exact<std::uint64_t>(value);
}

TEST(Numbers, Are_exact_or_refused) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 20'000; ++i) {
    const auto bits = random() >> (random() % 64U);
    expect_exact_in_all(static_cast<std::int64_t>(bits));
    expect_exact_in_all(-static_cast<std::int64_t>(bits >> 1U));
    expect_exact_in_all(bits);
    expect_exact_in_all(static_cast<double>(bits));
    expect_exact_in_all(-static_cast<double>(bits));
    expect_exact_in_all(static_cast<double>(bits) / 4);
  }
  expect_exact_in_all(std::numeric_limits<double>::infinity());
  expect_exact_in_all(std::ldexp(1.0, 63));
  expect_exact_in_all(std::ldexp(1.0, 64));
  expect_exact_in_all(-std::ldexp(1.0, 63));
  EXPECT_FALSE(exactly<std::int32_t>(std::numeric_limits<double>::quiet_NaN()));
}

TEST(Numbers, Of_floating_point_are_rounded_but_stay_finite) {
  EXPECT_EQ(exactly<float>(0.1), 0.1F);
  EXPECT_FALSE(exactly<float>(1e300));
  EXPECT_TRUE(std::isinf(*exactly<float>(std::numeric_limits<double>::infinity())));
  EXPECT_TRUE(std::isnan(*exactly<float>(std::numeric_limits<double>::quiet_NaN())));
}

TEST(Numbers, Bools_are_true_or_false) {
  EXPECT_EQ(to_bytes(schema::Base::Bool, 7)->at(0), 1);
  EXPECT_EQ(to_bytes(schema::Base::Bool, true)->at(0), 1);
  EXPECT_EQ(from_bytes<int>(schema::Base::Bool, Bytes{1}), 1);
  EXPECT_FALSE(to_bytes(schema::Base::Text, 7));
}

}  // namespace
}  // namespace indurop::fmi
