// SPDX-License-Identifier: Apache-2.0
// Results that carry errors of their own type.
#include <gtest/gtest.h>
#include <indurop/result.h>

#include <memory>
#include <string>
#include <type_traits>

#include "core/base/problem.h"

namespace indurop {
namespace {

using base::Problem;

Result<int, Problem> half_of(int number) {
  if (number % 2 != 0) {
    return Problem{std::to_string(number) + " is odd"};
  }
  return number / 2;
}

Result<void, Problem> require_even(int number) {
  if (auto half = half_of(number); !half) {
    return std::move(half).error();
  }
  return {};
}

TEST(ResultTest, Holds_the_value_or_a_problem_in_words) {
  for (int number = -50; number <= 50; ++number) {
    const auto sut = half_of(number);
    ASSERT_EQ(sut.ok(), number % 2 == 0);
    if (sut) {
      EXPECT_EQ(2 * *sut, number);
    } else {
      EXPECT_EQ(sut.error().text, std::to_string(number) + " is odd");
    }
  }
}

TEST(ResultTest, Without_a_value_tells_only_how_it_went) {
  EXPECT_TRUE(require_even(4).ok());
  const auto sut = require_even(5);
  ASSERT_FALSE(sut.ok());
  EXPECT_EQ(sut.error().text, "5 is odd");
}

TEST(ResultTest, Holds_what_can_only_be_moved) {
  Result<std::unique_ptr<int>, Problem> sut(std::make_unique<int>(3));
  const std::unique_ptr<int> taken = std::move(sut).value();
  EXPECT_EQ(*taken, 3);
}

TEST(ResultTest, Text_is_a_value_and_a_problem_is_not) {
  const Result<std::string, Problem> value(std::string("eth0"));
  const Result<std::string, Problem> error(Problem{"no interface"});
  EXPECT_EQ(*value, "eth0");
  EXPECT_EQ(error.error().text, "no interface");
}

TEST(ResultTest, Plain_errors_need_no_heap) {
  static_assert(std::is_trivially_copyable_v<Result<int>>);
  static_assert(std::is_same_v<Result<int>, Result<int, Error>>);
  const Result<int> sut(Error{Errc::Busy, 0, "lock"});
  EXPECT_EQ(sut.error().code, Errc::Busy);
}

TEST(ResultDeathTest, Asking_for_what_is_not_there_aborts) {
  EXPECT_DEATH((void)half_of(3).value(), "");
  EXPECT_DEATH((void)half_of(4).error(), "");
  EXPECT_DEATH((void)require_even(4).error(), "");
}

}  // namespace
}  // namespace indurop
