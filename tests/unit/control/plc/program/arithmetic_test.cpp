// SPDX-License-Identifier: Apache-2.0
// Expressions and calls of compiled programs: arithmetic.st.

#include <indurop/indurop.h>

#include <gtest/gtest.h>
#include <plc_test_arithmetic.glb.h>

#include "module.h"

namespace v = plc_test_arithmetic;

TEST(PlcArithmetic, Results_are_those_of_the_standard) {
  const indurop::testing::PlcModule sut("plc_test_arithmetic");
  sut.scan();
  EXPECT_EQ(v::main_sint_wraps.get(), -128);
  EXPECT_EQ(v::main_usint_wraps.get(), 0);
  EXPECT_EQ(v::main_int_wraps.get(), -2);
  EXPECT_EQ(v::main_quotient.get(), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(v::main_remainder.get(), -3);
  EXPECT_EQ(v::main_cut.get(), -3);
  EXPECT_EQ(v::main_power.get(), 1024.0);
  EXPECT_EQ(v::main_half_even_low.get(), 2);
  EXPECT_EQ(v::main_half_even_high.get(), 4);
  EXPECT_EQ(v::main_precedence.get(), 12);
  EXPECT_EQ(v::main_unary_first.get(), 4.0);
  EXPECT_EQ(v::main_mask.get(), 0xFF0E);
  EXPECT_EQ(v::main_shifted_out.get(), 0);
  EXPECT_EQ(v::main_rotated.get(), 0x0F0F);
  EXPECT_TRUE(v::main_all_bits.get());
  EXPECT_TRUE(v::main_bit_four.get());
  EXPECT_EQ(v::main_with_bit.get(), 9);
  EXPECT_EQ(v::main_wide.get(), -2147450881LL);
  EXPECT_EQ(v::main_mixed.get(), 81917.5);
  EXPECT_EQ(v::main_based.get(), 0xDEADBEEFU);
}

TEST(PlcArithmetic, Calls_pass_what_they_name) {
  const indurop::testing::PlcModule sut("plc_test_arithmetic");
  sut.scan();
  EXPECT_EQ(v::main_chosen.get(), 30);
  EXPECT_EQ(v::main_limited.get(), 50);
  EXPECT_EQ(v::main_greatest.get(), 32767);
  EXPECT_EQ(v::main_clamped.get(), 10);
  EXPECT_EQ(v::main_clamped_named.get(), 99);
  EXPECT_TRUE(v::main_split_sign.get());
  EXPECT_EQ(v::main_tens.get(), 42);
  EXPECT_EQ(v::main_ones.get(), 7);
  EXPECT_GE(v::main_calls.get(), 1);
  EXPECT_EQ(v::main_enabled.get(), 3);
  EXPECT_EQ(v::main_not_enabled.get(), 7);
  EXPECT_FALSE(v::main_eno.get());
}
