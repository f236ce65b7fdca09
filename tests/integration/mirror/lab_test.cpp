// SPDX-License-Identifier: Apache-2.0
// Boards as network namespaces: the cable, loss, and three boards at once. Needs root and the ip command.

#include "lab.h"

namespace indurop::test {
namespace {

using mirror::PeerState;

TEST_F(Lab, Three_boards_pass_a_value_on) {
  NEEDS_LAB("a b c");
  start({"a", "t::count", "-", "plain"}, {"b", "c"}, lab());
  start({"b", "t::reply", "t::count@a", "plain"}, {"a", "c"}, lab());
  start({"c", "-", "t::count@a,t::reply@b", "plain"}, {"a", "b"}, lab());
  for (std::int64_t i = 1; i <= 20; ++i) {
    put("a", "t::count", i);
    ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == i; }));
    put("b", "t::reply", i * 2);
    ASSERT_TRUE(wait_until(
        [&] { return get<std::int64_t>("c", "t::count") == i && get<std::int64_t>("c", "t::reply") == i * 2; }));
  }
}

TEST_F(Lab, A_cable_pulled_and_put_back) {
  NEEDS_LAB("a b");
  start({"a", "t::count,t::guarded", "-", "plain"}, {"b"}, lab());
  start({"b", "-", "t::count@a,t::guarded@a", "plain"}, {"a"}, lab());
  put("a", "t::count", std::int64_t{1});
  put("a", "t::guarded", std::int32_t{3});
  ASSERT_TRUE(
      wait_until([&] { return get<std::int64_t>("b", "t::count") == 1 && get<std::int32_t>("b", "t::guarded") == 3; }));
  ASSERT_EQ(run("unplug a"), 0);
  ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Silent); }));
  EXPECT_TRUE(wait_until([&] { return get<std::int32_t>("b", "t::guarded") == -1; }));
  put("a", "t::count", std::int64_t{2});
  ASSERT_EQ(run("plug a"), 0);
  EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == 2; }));
  EXPECT_TRUE(
      wait_until([&] { return sees("b", "a", PeerState::Alive) && get<std::int32_t>("b", "t::guarded") == 3; }));
}

TEST_F(Lab, The_last_value_arrives_whatever_is_lost) {
  NEEDS_LAB("a b");
  start({"a", "t::count,t::pair", "-", "plain"}, {"b"}, lab());
  start({"b", "-", "t::count@a,t::pair@a", "plain"}, {"a"}, lab());
  ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Alive); }));
  if (run("loss b 30 2>/dev/null") != 0) {
    GTEST_SKIP() << "iptables cannot lose packets here";
  }
  for (std::int64_t i = 1; i <= 30; ++i) {
    put("a", "t::count", i);
    ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == i; })) << i;
  }
}

TEST_F(Lab, A_board_whose_interface_is_missing_joins_when_it_comes) {
  NEEDS_LAB("a b");
  ASSERT_EQ(run("exec a ip link set eth0 down"), 0);
  start({"a", "t::count", "-", "plain"}, {"b"}, lab());
  start({"b", "-", "t::count@a", "plain"}, {"a"}, lab());
  put("a", "t::count", std::int64_t{4});
  EXPECT_TRUE(wait_until([&] { return !block("a").problem.get().empty(); }));
  EXPECT_EQ(block("a").network.load(), mirror::Network::Connecting);
  ASSERT_EQ(run("exec a ip link set eth0 up"), 0);
  EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == 4; }));
  EXPECT_EQ(block("a").problem.get(), "");
}

TEST_F(Lab, A_standby_takes_over_and_keeps_the_lead) {
  NEEDS_LAB("a b c");
  start({"a", "t::count", "-", "plain"}, {"b", "c"}, lab());
  start({"b", "t::count", "-", "plain"}, {"a", "c"}, lab());
  start({"c", "-", "t::count@a,t::count@b", "plain"}, {"a", "b"}, lab());
  put("a", "t::count", std::int64_t{100});
  put("b", "t::count", std::int64_t{101});
  ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("c", "t::count") == 100; })) << "the longest in service leads";
  ASSERT_TRUE(wait_until([&] { return peer("c", "b").frames.load() > 2; }));
  EXPECT_EQ(get<std::int64_t>("c", "t::count"), 100);
  stop("a", SIGKILL);
  ASSERT_TRUE(wait_until([&] { return get<std::int64_t>("c", "t::count") == 101; }));
  EXPECT_GT(confirmed("c", "t::count"), 0) << "valid all the time";
  start({"a", "t::count", "-", "plain"}, {"b", "c"}, lab());
  put("a", "t::count", std::int64_t{102});
  ASSERT_TRUE(wait_until([&] { return sees("c", "a", PeerState::Alive) && peer("c", "a").frames.load() > 0; }));
  put("b", "t::count", std::int64_t{103});
  EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("c", "t::count") == 103; }));
  stop("b", SIGKILL);
  EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("c", "t::count") == 102; }));
}

TEST_F(Lab, Two_boards_of_one_name_say_so) {
  NEEDS_LAB("a b");
  start({"a", "t::count", "-", "plain"}, {"c"}, lab());
  start_as("b", {"a", "t::count", "-", "plain"}, {"c"}, lab());  // a second board a, on another machine
  for (const char* place : {"a", "b"}) {
    EXPECT_TRUE(wait_until([&] { return block(place).problem.get().find("runs as board a") != std::string::npos; }));
  }
  stop("b");
  EXPECT_TRUE(wait_until([&] { return block("a").problem.get().empty(); }));
}

TEST_F(Lab, A_flood_of_garbage_at_the_ports_disturbs_no_board) {
  NEEDS_LAB("a b evil");
  start({"a", "t::count", "-", "plain"}, {"b"}, lab());
  start({"b", "-", "t::count@a", "plain"}, {"a"}, lab());
  ASSERT_TRUE(wait_until([&] { return sees("b", "a", PeerState::Alive); }));
  std::thread flood(
      [&] { (void)run("exec evil python3 " GARBAGE_PROGRAM " 10.77.0.2 " + std::to_string(domain()) + " 20000"); });
  for (std::int64_t i = 1; i <= 50; ++i) {
    put("a", "t::count", i);
    EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == i; })) << i;
  }
  flood.join();
  put("a", "t::count", std::int64_t{999});
  EXPECT_TRUE(wait_until([&] { return get<std::int64_t>("b", "t::count") == 999; }));
}

}  // namespace
}  // namespace indurop::test
