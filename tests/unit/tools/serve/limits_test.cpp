// SPDX-License-Identifier: Apache-2.0
// A waiting client keeps no other one out, and a guessing one is recorded, in memory that has a limit.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tools/serve/door/connection_limits.h"
#include "tools/serve/door/wrong_tokens.h"

namespace indurop::serve {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

TEST(Limits, End_the_longest_waiting_for_a_new_one) {
  ConnectionLimits limits(3, 3);
  const auto first = limits.admit("10.0.0.1", false);
  const auto second = limits.admit("10.0.0.2", false);
  const auto third = limits.admit("10.0.0.3", false);
  EXPECT_FALSE(third.instead);
  limits.busy(first.id);
  EXPECT_EQ(limits.admit("10.0.0.4", false).instead, second.id);
  limits.waiting(first.id);  // since now only
  EXPECT_EQ(limits.admit("10.0.0.5", false).instead, third.id);
  EXPECT_EQ(limits.size(), 3U);
}

TEST(Limits, Never_end_who_is_answered) {
  ConnectionLimits limits(2, 2);
  limits.busy(limits.admit("127.0.0.1", true).id);
  const auto second = limits.admit("127.0.0.1", true);
  limits.busy(second.id);
  EXPECT_EQ(limits.admit("127.0.0.1", true).id, 0U);
  limits.gone(second.id);
  EXPECT_NE(limits.admit("127.0.0.1", true).id, 0U);
}

TEST(Limits, Let_an_address_have_its_share_only) {
  ConnectionLimits limits(100, 4);
  const auto other = limits.admit("10.0.0.1", false);
  std::vector<ConnectionLimits::Id> own;
  for (int i = 0; i < 4; ++i) {
    own.push_back(limits.admit("10.0.0.9", false).id);
  }
  EXPECT_EQ(limits.admit("10.0.0.9", false).instead, own.front())
      << "one of its own, though " << other.id << " waits longer";
  for (int i = 0; i < 50; ++i) {
    EXPECT_FALSE(limits.admit("127.0.0.1", true).instead);
  }
  EXPECT_EQ(limits_key("2001:db8:1:2:3:4:5:6"), limits_key("2001:db8:1:2::1")) << "one network";
  EXPECT_NE(limits_key("2001:db8:1:2::1"), limits_key("2001:db8:1:3::1"));
  EXPECT_EQ(limits_key("10.0.0.1"), "10.0.0.1");
}

// 320 idle connections, and more of them again and again: everybody else comes in each time.
TEST(Limits, Idle_ones_lock_no_client_out) {
  ConnectionLimits limits(256, 64);
  for (int i = 0; i < 10000; ++i) {
    EXPECT_NE(limits.admit("127.0.0.1", true).id, 0U);
    if (i % 320 == 0) {
      const auto honest = limits.admit("127.0.0.1", true);
      ASSERT_NE(honest.id, 0U);
      limits.busy(honest.id);
      limits.gone(honest.id);
    }
  }
  EXPECT_LE(limits.size(), 256U);
}

TEST(WrongTokens, Are_held_back_longer_and_longer) {
  WrongTokens sut;
  std::int64_t before = 0;
  for (std::uint64_t i = 0; i < 50; ++i) {
    const auto verdict = sut.wrong("10.0.0.1", kSecond);
    EXPECT_EQ(verdict.delay_ns == 0, i < WrongTokens::kAtOnce) << i;
    EXPECT_GE(verdict.delay_ns, before);
    EXPECT_LE(verdict.delay_ns, WrongTokens::kMostDelayNs);
    before = verdict.delay_ns;
  }
  EXPECT_EQ(before, WrongTokens::kMostDelayNs);
  EXPECT_EQ(sut.wrong("10.0.0.2", kSecond).delay_ns, 0) << "another client";
  EXPECT_EQ(sut.wrong("10.0.0.1", kSecond + WrongTokens::kWindowNs + 1).delay_ns, 0) << "it is forgotten";
}

TEST(WrongTokens, Are_noted_down_once_in_a_while_and_none_is_left_out) {
  WrongTokens sut;
  std::uint64_t noted = 0;
  std::uint64_t notes = 0;
  constexpr int kAll = 12000;
  for (int i = 0; i < kAll; ++i) {
    const auto verdict = sut.wrong("10.0.0.1", kSecond + i * kSecond / 100);
    noted += verdict.note;
    notes += verdict.note > 0 ? 1U : 0U;
  }
  EXPECT_LE(notes, 3U) << "in two minutes";
  EXPECT_GE(notes, 2U);
  EXPECT_GT(noted, static_cast<std::uint64_t>(kAll) / 3);
}

TEST(WrongTokens, Have_a_limit_in_memory_and_in_notes_whatever_comes) {
  WrongTokens sut;
  std::uint64_t notes = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::string address = "10." + std::to_string(i % 256) + "." + std::to_string(i / 256 % 256) + ".1";
    notes += sut.wrong(address, kSecond + i).note > 0 ? 1U : 0U;
    ASSERT_LE(sut.size(), WrongTokens::kMostAddresses);
  }
  EXPECT_LE(notes, WrongTokens::kMostNotes);
}

}  // namespace
}  // namespace indurop::serve
