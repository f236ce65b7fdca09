// SPDX-License-Identifier: Apache-2.0
// Two boards on loopback: values, late joiners, restarts, silence, disagreement about types.

#include <array>

#include "boards.h"

namespace indurop::test {
namespace {

using mirror::PeerState;

constexpr const char* kAll = "t::count,t::pair,t::large,t::loose,t::guarded";
constexpr const char* kAllFromA = "t::count@a,t::pair@a,t::large@a,t::loose@a,t::guarded@a";
using Large = std::array<std::uint64_t, 12'500>;

class OneHost : public Boards {
 protected:
  void start_a() { start({"a", kAll, "t::reply@b", "plain"}, {"b"}); }
  void start_b() { start({"b", "t::reply", kAllFromA, "plain"}, {"a"}); }
  void start_both() {
    start_a();
    start_b();
    ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Alive) && sees("a", "b", PeerState::Alive); }))
        << block("a").problem.get() << block("b").problem.get();
  }
};

TEST_F(OneHost, What_one_board_writes_the_other_one_has) {
  start_both();
  for (std::int64_t i = 1; i <= 50; ++i) {
    put("a", "t::count", i);
    put("b", "t::reply", -i);
    ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == i; })) << i;
    ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("a", "t::reply") == -i; })) << i;
  }
  EXPECT_GT(peer("b", "a").frames.load(), 0U);
  EXPECT_EQ(peer("b", "a").tick.load(), 6U);
  EXPECT_EQ(peer("b", "a").refused.load(), 0U);
}

TEST_F(OneHost, Values_of_every_kind_arrive) {
  start_both();
  put("a", "t::pair", std::array<std::uint64_t, 2>{3, 4});
  put("a", "t::loose", std::int32_t{5});
  Large large{};
  large.fill(0x1234567890abcdef);
  put("a", "t::large", large);
  EXPECT_TRUE(wait_until([&] { return get<std::array<std::uint64_t, 2>>("b", "t::pair")[1] == 4; }));
  EXPECT_TRUE(wait_until([&] { return get<std::int32_t>("b", "t::loose") == 5; }));
  EXPECT_TRUE(wait_until([&] { return get<Large>("b", "t::large") == large; }));
}

TEST_F(OneHost, A_value_is_never_mixed_from_two_writes) {
  start_both();
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (std::uint64_t i = 1; !stop; ++i) {
      put("a", "t::pair", std::array<std::uint64_t, 2>{i, ~i});
      Large large{};
      large.fill(i);
      put("a", "t::large", large);
    }
  });
  std::uint64_t last = 0;
  EXPECT_TRUE(wait_until([&] {
    const auto pair = get<std::array<std::uint64_t, 2>>("b", "t::pair");
    if (pair[0] != 0) {
      EXPECT_EQ(pair[1], ~pair[0]);
      EXPECT_GE(pair[0], last) << "values went back in time";
      last = pair[0];
    }
    const auto large = get<Large>("b", "t::large");
    EXPECT_EQ(large.front(), large.back());
    return large.front() > 20;
  }));
  stop = true;
  writer.join();
}

TEST_F(OneHost, A_late_joiner_gets_the_last_values) {
  start_a();
  put("a", "t::count", std::int64_t{77});
  put("a", "t::pair", std::array<std::uint64_t, 2>{1, 2});
  ASSERT_TRUE(wait_until([&] { return block("a").frames.load() > 0; }));
  start_b();
  EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == 77; }));
  EXPECT_TRUE(wait_until([&] { return get<std::array<std::uint64_t, 2>>("b", "t::pair")[1] == 2; }));
}

TEST_F(OneHost, Before_its_owner_was_heard_a_value_is_not_valid) {
  start_b();
  EXPECT_EQ(confirmed("b", "t::count"), abi::kNeverConfirmed);
  EXPECT_EQ(confirmed("b", "t::reply"), 0) << "its own";
  EXPECT_TRUE(sees("b", "a", PeerState::Absent));
}

TEST_F(OneHost, A_killed_board_is_noticed_and_its_return_too) {
  start_both();
  put("a", "t::count", std::int64_t{5});
  put("a", "t::guarded", std::int32_t{8});
  ASSERT_TRUE(wait_until([&] { return get<std::int32_t>("b", "t::guarded") == 8 && confirmed("b", "t::count") > 0; }));
  stop("a", SIGKILL);
  ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Silent); }));
  EXPECT_LT(confirmed("b", "t::count"), 0);
  EXPECT_EQ(get<std::int64_t>("b", "t::count"), 5) << "without a fallback the last value stays";
  EXPECT_TRUE(wait_until([&] { return get<std::int32_t>("b", "t::guarded") == -1; })) << "the declared fallback";
  start_a();
  EXPECT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Alive) && confirmed("b", "t::count") > 0; }));
  put("a", "t::count", std::int64_t{6});
  EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == 6; }));
  EXPECT_EQ(peer("b", "a").losses.load(), 1U);
}

TEST_F(OneHost, A_board_that_stood_still_for_longer_than_a_lease_is_alive_again) {
  start_both();
  ASSERT_TRUE(wait_until([&] { return confirmed("b", "t::count") > 0; }));
  for (int round = 1; round <= 3; ++round) {
    hold("a");
    ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Silent); })) << round;
    EXPECT_LT(confirmed("b", "t::count"), 0);
    let_run("a");
    ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Alive) && confirmed("b", "t::count") > 0; }))
        << round;
  }
}

TEST_F(OneHost, A_board_that_ends_is_noticed_at_once) {
  start_both();
  stop("a");
  EXPECT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Silent); }));
}

TEST_F(OneHost, A_value_changed_by_hand_is_set_right) {
  start_both();
  put("a", "t::count", std::int64_t{5});
  ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == 5; }));
  put("b", "t::count", std::int64_t{99});
  EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == 5; }));
}

TEST_F(OneHost, A_value_that_does_not_change_is_confirmed_again_and_again) {
  start_both();
  put("a", "t::guarded", std::int32_t{8});
  ASSERT_TRUE(wait_until([&] { return get<std::int32_t>("b", "t::guarded") == 8; }));
  const std::int64_t first = confirmed("b", "t::guarded");
  EXPECT_TRUE(wait_until([&] {
    EXPECT_EQ(get<std::int32_t>("b", "t::guarded"), 8);
    return confirmed("b", "t::guarded") - first > 1'500'000'000;  // longer than its maxage
  }));
}

TEST_F(OneHost, Boards_compare_their_clocks) {
  start_both();
  ASSERT_TRUE(
      wait_until([&] { return peer("a", "b").clock_known.load() != 0 && peer("b", "a").clock_known.load() != 0; }));
  // It is one clock, so the truth is 0.
  EXPECT_LE(std::abs(peer("a", "b").clock_offset_ns.load()), peer("a", "b").clock_bound_ns.load());
  EXPECT_LE(std::abs(peer("b", "a").clock_offset_ns.load()), peer("b", "a").clock_bound_ns.load());
}

TEST_F(OneHost, Different_types_are_named_and_nothing_is_taken_over) {
  start({"a", "t::count,t::pair", "-", "other"}, {"b"});
  start({"b", "-", "t::count@a,t::pair@a", "plain"}, {"a"});
  ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Mismatched); }));
  EXPECT_THAT(peer("b", "a").problem.get(), ::testing::HasSubstr("t::pair differs between the boards"));
  EXPECT_THAT(peer("b", "a").problem.get(), ::testing::HasSubstr("float"));
  EXPECT_EQ(peer("b", "a").frames.load(), 0U);
}

TEST_F(OneHost, A_variable_the_other_board_does_not_send_is_named) {
  start({"a", "t::count", "-", "plain"}, {"b"});
  start({"b", "-", "t::count@a,t::loose@a", "plain"}, {"a"});
  ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Mismatched); }));
  EXPECT_THAT(peer("b", "a").problem.get(), ::testing::HasSubstr("board a does not send t::loose"));
}

}  // namespace
}  // namespace indurop::test
