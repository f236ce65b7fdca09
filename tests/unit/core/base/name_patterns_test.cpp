// SPDX-License-Identifier: Apache-2.0
#include "core/base/name_patterns.h"

#include <gtest/gtest.h>

namespace indurop::base {
namespace {

TEST(NamePatterns, No_pattern_limits_nothing) {
  EXPECT_TRUE(matches_any({}, "press"));
  EXPECT_TRUE(matches_any_variable({}, "cell::gain"));
}

TEST(NamePatterns, Match_whole_names) {
  EXPECT_TRUE(matches_any({"oven", "press*"}, "press2"));
  EXPECT_FALSE(matches_any({"press"}, "press2"));
  EXPECT_FALSE(matches_any({"*press"}, "press2"));
}

TEST(NamePatterns, Stand_for_a_variable_or_for_a_part_of_it) {
  EXPECT_TRUE(matches_any_variable({"cell::arm"}, "cell::arm.joint[2].speed"));
  EXPECT_TRUE(matches_any_variable({"cell::arm"}, "cell::arm[2]"));
  EXPECT_TRUE(matches_any_variable({"cell::arm.speed"}, "cell::arm.speed"));
  EXPECT_FALSE(matches_any_variable({"cell::arm.speed"}, "cell::arm.torque"));
  EXPECT_FALSE(matches_any_variable({"cell::ar"}, "cell::arm.speed"));
}

}  // namespace
}  // namespace indurop::base
