// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/unit/glb2idl/compile_helper.h"

namespace indurop::glb2idl {
namespace {

// The value of an expression as text, or the message.
std::string value_of(const std::string& expression) {
  const Compilation sut = test::compile_text("namespace t;\n#define BEFORE 7\n#define X " + expression + "\n");
  if (!sut.ok) {
    return sut.diagnostics.front().text;
  }
  return to_text(std::get<Constant>(sut.program.units[0].items.back()).value);
}

TEST(Constant, Operators_have_the_precedence_of_C) {
  EXPECT_EQ(value_of("2 + 3 * 4"), "14");
  EXPECT_EQ(value_of("(2 + 3) * 4"), "20");
  EXPECT_EQ(value_of("1 | 2 ^ 3 & 6"), std::to_string(1 | (2 ^ (3 & 6))));
  EXPECT_EQ(value_of("1 << 2 + 1"), "8");
  EXPECT_EQ(value_of("7 - 4 - 2"), "1");
  EXPECT_EQ(value_of("-7 / 2"), "-3");
  EXPECT_EQ(value_of("-7 % 3"), "-1");
  EXPECT_EQ(value_of("- -3 + +2"), "5");
  EXPECT_EQ(value_of("~0"), "-1");
  EXPECT_EQ(value_of("1 < 2 == true"), "true");
  EXPECT_EQ(value_of("0 || 1 && 0"), "false");
  EXPECT_EQ(value_of("1 ? 2 : 0 ? 3 : 4"), "2");
  EXPECT_EQ(value_of("BEFORE * 2"), "14");
}

TEST(Constant, Integers_and_doubles_mix_as_in_C) {
  EXPECT_EQ(value_of("7 / 2"), "3");
  EXPECT_EQ(value_of("7 / 2.0"), "3.5");
  EXPECT_EQ(value_of("1e3 + 1"), "1001");
  EXPECT_EQ(value_of("0.1f"), "0.1");
  EXPECT_EQ(value_of("1.0 < 2"), "true");
}

TEST(Constant, Numbers_are_written_as_in_C) {
  EXPECT_EQ(value_of("0x1F"), "31");
  EXPECT_EQ(value_of("017"), "15");
  EXPECT_EQ(value_of("0b101"), "5");
  EXPECT_EQ(value_of("1'000'000"), "1000000");
  EXPECT_EQ(value_of("10UL"), "10");
  EXPECT_EQ(value_of("'A'"), "65");
  EXPECT_EQ(value_of("'\\n'"), "10");
  EXPECT_EQ(value_of("18446744073709551615"), "18446744073709551615");
}

TEST(Constant, Overflow_and_division_by_zero_are_errors) {
  EXPECT_EQ(value_of("18446744073709551615 + 1"),
            "the result does not fit 64 bits, use smaller numbers or a double (1.0)");
  EXPECT_EQ(value_of("-9223372036854775808 - 1"),
            "the result does not fit 64 bits, use smaller numbers or a double (1.0)");
  EXPECT_EQ(value_of("(1 << 63) * (1 << 63) * (1 << 63)"),
            "the result does not fit 64 bits, use smaller numbers or a double (1.0)");
  EXPECT_EQ(value_of("1 << 63"), "9223372036854775808");
  EXPECT_EQ(value_of("-1 << 63"), "-9223372036854775808");
  EXPECT_EQ(value_of("3 << 63"), "the result does not fit 64 bits, use smaller numbers or a double (1.0)");
  EXPECT_EQ(value_of("5 / 0"), "division by zero, correct the divisor");
  EXPECT_EQ(value_of("5 % (3 - 3)"), "division by zero, correct the divisor");
  EXPECT_EQ(value_of("5.0 / 0"), "division by zero, correct the divisor");
  EXPECT_EQ(value_of("1 << 64"), "a shift is by 0 to 63 bits, correct it");
  EXPECT_EQ(value_of("1e308 * 10"), "the result does not fit a double, use smaller numbers");
}

TEST(Constant, The_part_not_chosen_is_not_evaluated) {
  EXPECT_EQ(value_of("true || 1 / 0"), "true");
  EXPECT_EQ(value_of("false && 1 / 0"), "false");
  EXPECT_EQ(value_of("1 ? 2 : 1 / 0"), "2");
}

TEST(Constant, Deep_or_long_expressions_are_errors) {
  EXPECT_NE(value_of(std::string(100'000, '(') + "1").find("levels deep"), std::string::npos);
  EXPECT_NE(value_of(std::string(100'000, '-') + "1").find("levels deep"), std::string::npos);
  std::string chain = "1";
  for (int i = 0; i < 100'000; ++i) {
    chain += "+1";
  }
  EXPECT_NE(value_of(chain).find("more than 1000 operators"), std::string::npos);
  std::string choice;
  for (int i = 0; i < 100'000; ++i) {
    choice += "1?";
  }
  EXPECT_NE(value_of(choice + "1").find("levels deep"), std::string::npos);
}

}  // namespace
}  // namespace indurop::glb2idl
