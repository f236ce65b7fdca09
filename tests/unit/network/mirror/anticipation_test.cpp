// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/anticipation.h"

#include <gtest/gtest.h>

namespace indurop::mirror {
namespace {

constexpr std::int64_t kAnticipatedMs = 1'000'000;

TEST(Anticipation, Knows_nothing_at_first) {
  const Anticipation sut;
  EXPECT_TRUE(sut.next(5 * kAnticipatedMs).empty());
}

TEST(Anticipation, Is_awake_around_the_next_report_of_a_steady_period) {
  Anticipation sut;
  for (std::uint64_t i = 1; i <= 20; ++i) {
    sut.reported(i, static_cast<std::int64_t>(i) * kAnticipatedMs);
  }
  const auto window = sut.next(20 * kAnticipatedMs + 1);
  ASSERT_FALSE(window.empty());
  EXPECT_EQ(window.begin, 21 * kAnticipatedMs - Anticipation::kBefore);
  EXPECT_EQ(window.end, 21 * kAnticipatedMs + Anticipation::kAfter);
}

TEST(Anticipation, Further_reports_of_one_tick_change_nothing) {
  Anticipation sut;
  for (std::uint64_t i = 1; i <= 20; ++i) {
    sut.reported(i, static_cast<std::int64_t>(i) * kAnticipatedMs);
    sut.reported(i, static_cast<std::int64_t>(i) * kAnticipatedMs + 300'000);
  }
  EXPECT_EQ(sut.next(20 * kAnticipatedMs + 1).end, 21 * kAnticipatedMs + Anticipation::kAfter);
}

TEST(Anticipation, Lost_ticks_do_not_disturb_the_period) {
  Anticipation sut;
  for (std::uint64_t i = 1; i <= 40; i += i % 5 == 0 ? 3U : 1U) {
    sut.reported(i, static_cast<std::int64_t>(i) * kAnticipatedMs);
  }
  EXPECT_FALSE(sut.next(40 * kAnticipatedMs + 1).empty());
}

TEST(Anticipation, Gives_up_when_the_time_has_passed) {
  Anticipation sut;
  for (std::uint64_t i = 1; i <= 20; ++i) {
    sut.reported(i, static_cast<std::int64_t>(i) * kAnticipatedMs);
  }
  EXPECT_TRUE(sut.next(21 * kAnticipatedMs + Anticipation::kAfter).empty());
}

TEST(Anticipation, A_period_too_short_to_sleep_in_between_is_not_spun_away) {
  Anticipation sut;
  for (std::uint64_t i = 1; i <= 20; ++i) {
    sut.reported(i, static_cast<std::int64_t>(i) * 100'000);
  }
  EXPECT_TRUE(sut.next(2 * kAnticipatedMs + 1).empty());
}

TEST(Anticipation, Irregular_reports_are_not_anticipated) {
  Anticipation sut;
  std::int64_t now = 0;
  for (std::uint64_t i = 1; i <= 50; ++i) {
    now += i % 2 == 0 ? kAnticipatedMs : 4 * kAnticipatedMs;
    sut.reported(i, now);
  }
  EXPECT_TRUE(sut.next(now + 1).empty());
}

}  // namespace
}  // namespace indurop::mirror
