// SPDX-License-Identifier: Apache-2.0
// Numbers that become whole: against rounding by the parity of the number below.
#include "control/io/number.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace indurop::io {
namespace {

Number rounded_half_to_even(Number value) {
  const Number below = std::floor(value);
  const Number rest = value - below;
  const bool is_odd = std::fmod(below, Number{2}) != 0;
  return rest > Number{0.5} || (rest == Number{0.5} && is_odd) ? below + 1 : below;
}

template <class T>
class Whole : public testing::Test {
 protected:
  static constexpr Number kLow = std::numeric_limits<T>::min();
  static constexpr Number kHigh = std::numeric_limits<T>::max();

  // Near a limit of the type, near a power of two, or just any.
  Number next() {
    constexpr std::array<Number, 7> kParts = {0, 0.25L, 0.5L, 0.75L, 1, 1.5L, 2};
    const Number sign = random_() % 2 == 0 ? 1 : -1;
    const Number part = sign * kParts[random_() % kParts.size()];
    switch (random_() % 4) {
      case 0:
        return kLow + part;
      case 1:
        return kHigh + part;
      case 2:
        return sign * std::ldexp(Number{1}, static_cast<int>(random_() % 70)) + part;
      default:
        return sign * std::ldexp(static_cast<Number>(random_()), -static_cast<int>(random_() % 64));
    }
  }

 private:
  std::mt19937_64 random_{7};
};

using WholeTypes = testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t, std::uint32_t,
                                  std::int64_t, std::uint64_t>;
TYPED_TEST_SUITE(Whole, WholeTypes);

TYPED_TEST(Whole, Is_the_nearest_that_the_type_has) {
  for (int i = 0; i < 100'000; ++i) {
    const Number value = this->next();
    const Number rounded = rounded_half_to_even(value);
    const Number nearest = std::fmin(std::fmax(rounded, this->kLow), this->kHigh);
    TypeParam whole = 1;
    ASSERT_EQ(to_whole(value, whole), nearest == rounded) << value;
    ASSERT_EQ(static_cast<Number>(whole), nearest) << value;
  }
}

TYPED_TEST(Whole, Not_a_number_changes_nothing_and_infinity_is_a_limit) {
  TypeParam whole = 5;
  EXPECT_FALSE(to_whole(std::numeric_limits<Number>::quiet_NaN(), whole));
  EXPECT_EQ(whole, 5);
  EXPECT_FALSE(to_whole(-std::numeric_limits<Number>::infinity(), whole));
  EXPECT_EQ(whole, std::numeric_limits<TypeParam>::min());
}

}  // namespace
}  // namespace indurop::io
