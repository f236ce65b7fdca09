// SPDX-License-Identifier: Apache-2.0
// Conditions of alarms and how they are written.

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/unit/core/schema/types.h"

namespace indurop::schema {
namespace {

Alarm alarm(Comparison comparison, double limit, double deadband = 0) {
  return {"text", Priority::High, comparison, limit, deadband, 0};
}

TEST(AlarmCondition, Compares_the_value_with_the_limit) {
  struct Case {
    Comparison comparison;
    std::array<bool, 3> met;  // by 79, 80, 81
  };
  constexpr std::array kCases{
      Case{Comparison::Equal, {false, true, false}},   Case{Comparison::NotEqual, {true, false, true}},
      Case{Comparison::Less, {true, false, false}},    Case{Comparison::LessEqual, {true, true, false}},
      Case{Comparison::Greater, {false, false, true}}, Case{Comparison::GreaterEqual, {false, true, true}}};
  for (const Case& one : kCases) {
    const Alarm sut = alarm(one.comparison, 80);
    EXPECT_EQ(is_met(sut, 79, false), one.met[0]) << symbol_of(one.comparison);
    EXPECT_EQ(is_met(sut, 80, false), one.met[1]) << symbol_of(one.comparison);
    EXPECT_EQ(is_met(sut, 81, false), one.met[2]) << symbol_of(one.comparison);
  }
}

TEST(AlarmCondition, Ends_behind_the_deadband) {
  const Alarm high = alarm(Comparison::Greater, 80, 5);
  EXPECT_FALSE(is_met(high, 79, false));
  EXPECT_TRUE(is_met(high, 79, true));
  EXPECT_FALSE(is_met(high, 75, true));
  const Alarm low = alarm(Comparison::Less, 4, 1);
  EXPECT_TRUE(is_met(low, 4.5, true));
  EXPECT_FALSE(is_met(low, 5, true));
}

TEST(AlarmCondition, Is_not_met_by_what_is_no_number) {
  EXPECT_FALSE(is_met(alarm(Comparison::Greater, 80, 5), std::numeric_limits<double>::quiet_NaN(), true));
}

TEST(AlarmCondition, Is_written_as_it_was_declared) {
  EXPECT_EQ(condition_text(number(Base::Bool), alarm(Comparison::Equal, 1)), "");
  EXPECT_EQ(condition_text(number(Base::Bool), alarm(Comparison::NotEqual, 1)), "== false");
  EXPECT_EQ(condition_text(number(Base::Bool), alarm(Comparison::Equal, 0)), "== false");
  EXPECT_EQ(condition_text(number(Base::Double), alarm(Comparison::LessEqual, 2.5)), "<= 2.5");
  const Type mode = mode_type();
  const Alarm last = alarm(Comparison::Equal, static_cast<double>(mode.enumerators.back().value));
  EXPECT_EQ(condition_text(mode, last), "== " + mode.enumerators.back().name);
}

TEST(AlarmCondition, Priorities_are_words) {
  EXPECT_EQ(priority_of("critical"), Priority::Critical);
  EXPECT_EQ(priority_of(word_of(Priority::Low)), Priority::Low);
  EXPECT_FALSE(priority_of("urgent"));
}

}  // namespace
}  // namespace indurop::schema
