// SPDX-License-Identifier: Apache-2.0
// Globs and suggestions.

#include "core/base/nearest.h"

#include <gmock/gmock.h>

#include "core/schema/idl_word.h"
#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

TEST(IdlWord, Keywords_are_escaped_in_whatever_case) {
  EXPECT_TRUE(is_idl_keyword("SEQUENCE"));
  EXPECT_FALSE(is_idl_keyword("position"));
  EXPECT_EQ(idl_name("Port"), "_Port");
  EXPECT_EQ(idl_name("position"), "position");
}

TEST(Glob, Matches_as_a_shell_does) {
  EXPECT_TRUE(glob_match("*", "knu::Robot::joints"));
  EXPECT_TRUE(glob_match("knu::Robot::*", "knu::Robot::joints"));
  EXPECT_TRUE(glob_match("knu::*::j?ints", "knu::Robot::joints"));
  EXPECT_TRUE(glob_match("*[a-z]s", "knu::Robot::joints"));
  EXPECT_TRUE(glob_match("v[!0-4]", "v7"));
  EXPECT_TRUE(glob_match("v[^0-4]", "v7"));
  EXPECT_TRUE(glob_match("v[]x]", "v]"));
  EXPECT_TRUE(glob_match("v\\*", "v*"));
  EXPECT_TRUE(glob_match("**a**", "bab"));
  EXPECT_FALSE(glob_match("knu::Robot", "knu::Robot::joints"));
  EXPECT_FALSE(glob_match("v[!0-4]", "v3"));
  EXPECT_FALSE(glob_match("v\\*", "vx"));
  EXPECT_FALSE(glob_match("?", ""));
  EXPECT_FALSE(glob_match("", "a"));
  EXPECT_TRUE(glob_match("", ""));
}

TEST(Glob, Pattern_without_namespace_matches_the_last_part_too) {
  EXPECT_TRUE(glob_match("joi*", "knu::Robot::joints"));
  EXPECT_TRUE(glob_match("joints", "knu::Robot::joints"));
  EXPECT_FALSE(glob_match("Robot", "knu::Robot::joints"));
  EXPECT_FALSE(glob_match("Robot::joi*", "knu::Robot::joints"));
}

TEST(Glob, Name_may_lack_leading_namespaces) {
  EXPECT_TRUE(glob_match("Robot::joints", "knu::Robot::joints"));
  EXPECT_TRUE(glob_match("Robot.joints", "knu::Robot::joints"));
  EXPECT_FALSE(glob_match("bot::joints", "knu::Robot::joints"));
}

TEST(Glob, Dots_separate_namespaces_as_colons_do) {
  EXPECT_TRUE(glob_match("knu.Robot.*", "knu::Robot::joints"));
  EXPECT_FALSE(glob_match("knu.Robot.*", "knu::Rob::joints"));
}

TEST(Glob, Unfinished_patterns_are_letters) {
  EXPECT_TRUE(glob_match("a[", "a["));
  EXPECT_TRUE(glob_match("a[b", "a[b"));
  EXPECT_TRUE(glob_match("a\\", "a\\"));
  EXPECT_FALSE(glob_match("a[!]", "ab"));
}

TEST(Glob, Many_stars_take_no_exponential_time) {
  std::string pattern;
  for (int i = 0; i < 200; ++i) {
    pattern += "*a";
  }
  EXPECT_FALSE(glob_match(pattern + "b", std::string(2000, 'a')));
}

TEST(Nearest, Finds_the_slip_of_a_finger) {
  const std::vector<std::string> names{"joints", "tick", "period", "priority"};
  EXPECT_EQ(base::nearest("joint", names), "joints");
  EXPECT_EQ(base::nearest("JOINTS", names), "joints");
  EXPECT_EQ(base::nearest("preiod", names), "period");
  EXPECT_EQ(base::nearest("tcik", names), "tick");
  EXPECT_EQ(base::nearest("priorty", names), "priority");
}

TEST(Nearest, Says_nothing_when_nothing_is_close) {
  const std::vector<std::string> names{"joints", "a", ""};
  EXPECT_EQ(base::nearest("velocity", names), "");
  EXPECT_EQ(base::nearest("b", names), "");
  EXPECT_EQ(base::nearest("", names), "");
  EXPECT_EQ(base::nearest("joints", {}), "");
  EXPECT_EQ(base::nearest(std::string(100'000, 'j'), names), "");
}

TEST(Nearest, First_of_equals_wins) {
  const std::vector<std::string> names{"axis2", "axis3"};
  EXPECT_EQ(base::nearest("axis1", names), "axis2");
}

}  // namespace
}  // namespace indurop::schema
