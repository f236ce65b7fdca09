// SPDX-License-Identifier: Apache-2.0
// How many attempts to sign in one client may have under way.

#include "tools/serve/users/sign_in_limit.h"

#include <gtest/gtest.h>

namespace indurop::serve {
namespace {

constexpr std::int64_t kOneSecondNs = 1'000'000'000;

TEST(SignInLimit, Guesses_about_one_user_leave_room_for_others_and_for_other_addresses) {
  SignInLimit sut;
  for (std::size_t i = 0; i < SignInLimit::kMostOfUser; ++i) {
    EXPECT_TRUE(sut.begin("10.0.0.1", "ada", 1));
    EXPECT_TRUE(sut.begin("10.0.0.1", "", 1)) << "of one who does not exist";
  }
  EXPECT_FALSE(sut.begin("10.0.0.1", "ada", 1));
  EXPECT_FALSE(sut.begin("10.0.0.1", "", 1));
  EXPECT_TRUE(sut.begin("10.0.0.1", "anna", 1));
  EXPECT_TRUE(sut.begin("10.0.0.2", "ada", 1));
}

TEST(SignInLimit, Guesses_about_all_users_leave_room_for_other_addresses) {
  SignInLimit sut;
  std::size_t begun = 0;
  for (int i = 0; i < 100; ++i) {
    begun += sut.begin("fd00::1:" + std::to_string(i), "user" + std::to_string(i), 1) ? 1U : 0U;
  }
  EXPECT_EQ(begun, SignInLimit::kMostOfAddress) << "a network of IPv6 counts as one address";
  EXPECT_TRUE(sut.begin("10.0.0.2", "user1", 1));
}

TEST(SignInLimit, A_right_password_makes_room_at_once_and_a_wrong_one_after_its_delay) {
  SignInLimit sut;
  for (int i = 0; i < 100; ++i) {
    const auto attempt = sut.begin("10.0.0.1", "ada", kOneSecondNs);
    ASSERT_TRUE(attempt);
    sut.end(*attempt, false, kOneSecondNs);
  }
  std::size_t guesses = 0;
  constexpr std::int64_t kSeconds = 60;
  for (std::int64_t now = kOneSecondNs; now < (kSeconds + 1) * kOneSecondNs; now += kOneSecondNs / 100) {
    if (const auto attempt = sut.begin("10.0.0.1", "ada", now)) {
      sut.end(*attempt, true, now);
      ++guesses;
    }
  }
  constexpr std::size_t kMost =
      std::size_t{kSeconds} / 2 * SignInLimit::kMostOfUser + 20;  // the first ones are delayed less
  EXPECT_LE(guesses, kMost);
  EXPECT_GE(guesses, std::size_t{kSeconds} / 2 * SignInLimit::kMostOfUser) << "its user is not locked out for good";
}

}  // namespace
}  // namespace indurop::serve
