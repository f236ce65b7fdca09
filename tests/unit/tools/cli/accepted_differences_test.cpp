// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/shadow/accepted_differences.h"

#include <gtest/gtest.h>

#include <limits>

namespace indurop::tools {
namespace {

AcceptedDifferences rules(const std::string& text) {
  auto parsed = AcceptedDifferences::parse(text);
  EXPECT_TRUE(parsed.ok()) << text;
  return parsed ? std::move(parsed).value() : AcceptedDifferences();
}

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(AcceptedDifferences, Without_a_rule_nothing_is_accepted) {
  EXPECT_FALSE(AcceptedDifferences().accept("cell::O1", 0));
  EXPECT_FALSE(rules("").accept("cell::O1", 0));
  EXPECT_FALSE(rules("joint < 1").accept("cell::O1", 0.5));
}

TEST(AcceptedDifferences, A_limit_is_exact) {
  EXPECT_TRUE(rules("joint < 0.01").accept("robot::joint", 0.009));
  EXPECT_FALSE(rules("joint < 0.01").accept("robot::joint", 0.01));
  EXPECT_TRUE(rules("joint <= 0.01").accept("robot::joint", 0.01));
  EXPECT_TRUE(rules("O* == 0").accept("cell::O7", 0)) << "a minus zero, or what follows the end of a text";
  EXPECT_FALSE(rules("O* == 0").accept("cell::O7", 1));
}

TEST(AcceptedDifferences, Only_inf_accepts_what_is_no_number) {
  EXPECT_FALSE(rules("name < inf").accept("cell::name", kInfinite));
  EXPECT_TRUE(rules("name <= inf").accept("cell::name", kInfinite));
  EXPECT_FALSE(rules("name <= 1e308").accept("cell::name", kInfinite));
}

TEST(AcceptedDifferences, All_rules_for_a_variable_must_hold) {
  const AcceptedDifferences sut = rules("* <= 5, cell.* <= 2 , O1 == 1");
  EXPECT_TRUE(sut.accept("robot::speed", 4));
  EXPECT_FALSE(sut.accept("cell::speed", 4));
  EXPECT_TRUE(sut.accept("cell::O1", 1));
  EXPECT_FALSE(sut.accept("cell::O1", 2));
  EXPECT_EQ(sut.unmatched({"robot::speed"}), (std::vector<std::string>{"cell.* <= 2", "O1 == 1"}));
}

TEST(AcceptedDifferences, What_is_no_rule_is_named) {
  for (const char* text : {"joint", "joint > 1", "joint < ", "< 1", "joint < -1", "joint < 1x", "joint < nan",
                           "O* == 0,, joint < 1", "joint < 1,"}) {
    const auto sut = AcceptedDifferences::parse(text);
    if (std::string(text).ends_with("1,")) {
      EXPECT_TRUE(sut.ok());
      continue;
    }
    ASSERT_FALSE(sut.ok()) << text;
    EXPECT_NE(sut.error().text.find("is no rule; write"), std::string::npos) << sut.error().text;
  }
}

}  // namespace
}  // namespace indurop::tools
