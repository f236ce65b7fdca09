// SPDX-License-Identifier: Apache-2.0
// Arithmetic of all integer types at their ends, division, and the functions of real numbers.

#include <gtest/gtest.h>
#include <indurop/plc/arithmetic.h>
#include <indurop/plc/math.h>

#include <cmath>
#include <limits>
#include <string>

namespace indurop::iec {
namespace {

constexpr Place kHere{"prog.st:12:5", "MAIN"};

template <class Call>
std::string fault_of(Call call) {
  try {
    call();
  } catch (const Fault& fault) {
    return fault.what();
  }
  return "no fault";
}

template <class T>
class PlcInteger : public testing::Test {
 public:
  static constexpr T kMin = std::numeric_limits<T>::min();
  static constexpr T kMax = std::numeric_limits<T>::max();
};
using AllIntegers = testing::Types<std::int8_t, std::int16_t, std::int32_t, std::int64_t, std::uint8_t, std::uint16_t,
                                   std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(PlcInteger, AllIntegers);

TYPED_TEST(PlcInteger, Wraps_around_at_both_ends) {
  constexpr TypeParam kOne = 1;
  EXPECT_EQ(add(this->kMax, kOne), this->kMin);
  EXPECT_EQ(sub(this->kMin, kOne), this->kMax);
  EXPECT_EQ(mul(this->kMax, TypeParam{2}), static_cast<TypeParam>(-2));
  EXPECT_EQ(mul(this->kMax, this->kMax), kOne);
  EXPECT_EQ(neg(this->kMin), this->kMin);
  EXPECT_EQ(abs(this->kMin), this->kMin);
}

TYPED_TEST(PlcInteger, Of_the_most_negative_number_by_minus_one_wraps) {
  const auto minus_one = static_cast<TypeParam>(-1);
  if constexpr (std::is_signed_v<TypeParam>) {
    EXPECT_EQ(div(kHere, this->kMin, minus_one), this->kMin);
    EXPECT_EQ(mod(kHere, this->kMin, minus_one), TypeParam{0});
  } else {
    EXPECT_EQ(div(kHere, this->kMax, minus_one), TypeParam{1});
    EXPECT_EQ(mod(kHere, this->kMax, minus_one), TypeParam{0});
  }
}

TYPED_TEST(PlcInteger, By_zero_is_a_fault_with_its_place) {
  EXPECT_EQ(fault_of([] { div(kHere, TypeParam{1}, TypeParam{0}); }), "prog.st:12:5: division by zero in MAIN");
  EXPECT_EQ(fault_of([] { mod(kHere, TypeParam{1}, TypeParam{0}); }), "prog.st:12:5: MOD by zero in MAIN");
}

TEST(PlcArithmetic, Division_cuts_toward_zero_and_the_remainder_has_the_sign_of_the_dividend) {
  struct Row {
    std::int16_t a, b, quotient, rest;
  };
  for (const auto& [a, b, quotient, rest] :
       {Row{7, 2, 3, 1}, Row{-7, 2, -3, -1}, Row{7, -2, -3, 1}, Row{-7, -2, 3, -1}, Row{0, 5, 0, 0}, Row{3, 7, 0, 3}}) {
    EXPECT_EQ(div(kHere, a, b), quotient) << a << " / " << b;
    EXPECT_EQ(mod(kHere, a, b), rest) << a << " MOD " << b;
  }
}

TEST(PlcArithmetic, Sums_and_products_take_any_number_of_operands_and_wrap_at_each) {
  using I = std::int16_t;
  EXPECT_EQ(add(I{1}, I{2}, I{3}, I{4}), 10);
  EXPECT_EQ(add(I{32767}, I{1}, I{-1}), 32767);
  EXPECT_EQ(mul(I{300}, I{300}, I{2}), static_cast<I>(180000));
  EXPECT_EQ(add(1.5, 2.5, -1.0), 3.0);
}

TEST(PlcArithmetic, Reals_follow_floating_point_except_that_division_by_zero_is_a_fault) {
  EXPECT_EQ(div(kHere, 1.0F, 4.0F), 0.25F);
  EXPECT_EQ(fault_of([] { div(kHere, 1.0F, 0.0F); }), "prog.st:12:5: division by zero in MAIN");
  EXPECT_EQ(fault_of([] { div(kHere, 0.0, -0.0); }), "prog.st:12:5: division by zero in MAIN");
  EXPECT_TRUE(std::isinf(mul(std::numeric_limits<float>::max(), 2.0F)));
  EXPECT_TRUE(std::isnan(div(kHere, std::nan(""), 2.0)));
}

TEST(PlcArithmetic, Absolute_values) {
  EXPECT_EQ(abs(std::int16_t{-5}), 5);
  EXPECT_EQ(abs(std::uint8_t{200}), 200);
  EXPECT_EQ(abs(-2.5F), 2.5F);
  EXPECT_FALSE(std::signbit(abs(-0.0)));
}

TEST(PlcArithmetic, A_long_place_is_cut_in_the_text_of_the_fault) {
  const std::string file(1000, 'x');
  const Fault fault({file.c_str(), "MAIN"}, "division by zero");
  EXPECT_EQ(std::string(fault.what()), std::string(239, 'x'));
}

TEST(PlcMath, Functions_of_real_numbers) {
  EXPECT_EQ(sqrt(6.25F), 2.5F);
  EXPECT_DOUBLE_EQ(ln(std::exp(2.0)), 2.0);
  EXPECT_DOUBLE_EQ(log(1000.0), 3.0);
  EXPECT_DOUBLE_EQ(exp(1.0), std::exp(1.0));
  const double right = std::acos(0.0);
  EXPECT_DOUBLE_EQ(sin(right), 1.0);
  EXPECT_DOUBLE_EQ(cos(0.0), 1.0);
  EXPECT_DOUBLE_EQ(tan(right / 2), 1.0);
  EXPECT_DOUBLE_EQ(asin(1.0), right);
  EXPECT_DOUBLE_EQ(acos(1.0), 0.0);
  EXPECT_DOUBLE_EQ(atan(1.0), right / 2);
  EXPECT_DOUBLE_EQ(atan2(1.0, -1.0), right * 1.5);
}

TEST(PlcMath, What_has_no_result_is_no_number_and_says_so) {
  EXPECT_FALSE(is_valid(sqrt(-1.0)));
  EXPECT_FALSE(is_valid(ln(-1.0F)));
  EXPECT_FALSE(is_valid(ln(0.0)));
  EXPECT_FALSE(is_valid(asin(2.0)));
  EXPECT_TRUE(is_valid(1.0F));
}

TEST(PlcMath, Powers_take_any_number_as_exponent) {
  EXPECT_EQ(expt(2.0F, std::int16_t{10}), 1024.0F);
  EXPECT_EQ(expt(2.0, std::uint64_t{3}), 8.0);
  EXPECT_EQ(expt(4.0, 0.5), 2.0);
  EXPECT_EQ(expt(2.0, std::int8_t{-1}), 0.5);
  EXPECT_EQ(expt(0.0, std::int8_t{0}), 1.0);
}

}  // namespace
}  // namespace indurop::iec
