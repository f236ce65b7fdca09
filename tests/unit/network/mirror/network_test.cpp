// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/simulated/network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace indurop::mirror {
namespace {

using namespace std::chrono_literals;
using Kind = Message::Kind;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kEnd = 1'000'000 * kMs;

Message message(Kind kind, std::uint32_t from, std::int64_t time_ns, std::uint32_t part = 0, std::uint8_t value = 0) {
  return {kind, from, part, time_ns, {value}};
}

class NetworkTest : public ::testing::Test {
 protected:
  // Board `to` hears what `from` sends on the stream.
  static void subscribe(SimulatedNetwork& network, std::uint32_t to, std::uint32_t from, Kind stream) {
    const auto part = from * static_cast<std::uint32_t>(kStreams) + static_cast<std::uint32_t>(stream);
    network.send(message(Kind::Subscribe, to, 0, part));
  }
  static std::vector<std::int64_t> times(const std::vector<Message>& messages) {
    std::vector<std::int64_t> out;
    for (const Message& one : messages) {
      out.push_back(one.time_ns);
    }
    return out;
  }
};

TEST_F(NetworkTest, Delays_subscribed_samples) {
  SimulatedNetwork sut({.delay = 2ms}, 3);
  subscribe(sut, 1, 0, Kind::Prompt);
  sut.send(message(Kind::Prompt, 0, 5 * kMs));
  EXPECT_EQ(sut.next_arrival(1), 7 * kMs);
  EXPECT_EQ(sut.next_arrival(2), INT64_MAX) << "it did not want it";
  EXPECT_TRUE(sut.take(1, 7 * kMs - 1).empty());
  EXPECT_EQ(times(sut.take(1, 7 * kMs)), (std::vector<std::int64_t>{7 * kMs}));
}

TEST_F(NetworkTest, Gives_the_last_frame_of_each_part_to_who_comes_late) {
  SimulatedNetwork sut({.delay = 1ms}, 2);
  sut.send(message(Kind::Prompt, 0, kMs, 0, 1));
  sut.send(message(Kind::Prompt, 0, 2 * kMs, 0, 2));
  sut.send(message(Kind::Prompt, 0, 2 * kMs, 1, 3));
  subscribe(sut, 1, 0, Kind::Prompt);
  const std::vector<Message> came = sut.take(1, kEnd);
  ASSERT_EQ(came.size(), 2U);
  EXPECT_EQ(came[0].body[0], 2);
  EXPECT_EQ(came[1].body[0], 3);
}

TEST_F(NetworkTest, Loses_best_effort_and_repeats_the_rest_in_order) {
  const auto run = [](Kind stream) {
    SimulatedNetwork sut({.delay = 1ms, .jitter = 3ms, .loss = 0.3, .seed = 7}, 2);
    subscribe(sut, 1, 0, stream);
    std::vector<std::uint8_t> values;
    std::vector<Message> all;
    for (std::uint8_t i = 0; i < 200; ++i) {
      sut.send(message(stream, 0, i * kMs, i, i));
    }
    for (Message& one : sut.take(1, kEnd)) {
      values.push_back(one.body[0]);
    }
    return values;
  };
  const std::vector<std::uint8_t> reliable = run(Kind::Prompt);
  EXPECT_EQ(reliable.size(), 200U);
  EXPECT_TRUE(std::is_sorted(reliable.begin(), reliable.end()));
  const std::vector<std::uint8_t> loose = run(Kind::BestEffort);
  EXPECT_GT(loose.size(), 110U);
  EXPECT_LT(loose.size(), 170U);
  EXPECT_FALSE(std::is_sorted(loose.begin(), loose.end())) << "the jitter is larger than the distance";
}

TEST_F(NetworkTest, Does_not_repeat_what_is_superseded) {
  SimulatedNetwork sut({.delay = 1ms, .loss = 0.5, .repeat = 100ms, .seed = 1}, 2);
  subscribe(sut, 1, 0, Kind::Prompt);
  for (std::uint8_t i = 0; i < 100; ++i) {
    sut.send(message(Kind::Prompt, 0, i * kMs, 0, i));  // the same part again and again
  }
  const std::vector<Message> came = sut.take(1, kEnd);
  EXPECT_LT(came.size(), 70U);
  EXPECT_EQ(came.back().body[0], 99) << "the last one comes";
}

TEST_F(NetworkTest, Is_the_same_with_the_same_seed_and_another_with_another) {
  const auto run = [](std::uint64_t seed) {
    SimulatedNetwork sut({.delay = 1ms, .jitter = 1ms, .loss = 0.1, .seed = seed}, 2);
    subscribe(sut, 1, 0, Kind::Prompt);
    for (std::uint32_t i = 0; i < 100; ++i) {
      sut.send(message(Kind::Prompt, 0, i * kMs, i));
    }
    return times(sut.take(1, kEnd));
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST_F(NetworkTest, A_pulled_cable_is_noticed_after_the_lease_and_what_was_missed_comes_when_it_is_back) {
  SimulatedNetwork sut({.delay = 1ms, .lease = 50ms}, 2);
  subscribe(sut, 1, 0, Kind::Prompt);
  sut.send(message(Kind::Catalogue, 0, 0));
  sut.send(message(Kind::Prompt, 0, 0, 0, 1));
  EXPECT_EQ(sut.take(1, kMs).size(), 2U);
  sut.cut(0, 10 * kMs);
  sut.send(message(Kind::Prompt, 0, 11 * kMs, 0, 2));
  for (const std::size_t board : {std::size_t{0}, std::size_t{1}}) {
    EXPECT_TRUE(sut.take(board, 60 * kMs - 1).empty());
    const std::vector<Message> came = sut.take(board, 60 * kMs);
    ASSERT_EQ(came.size(), 1U);
    EXPECT_EQ(came[0].kind, Kind::Gone);
    EXPECT_EQ(came[0].board, 1 - board);
  }
  sut.join(0, 100 * kMs);
  const std::vector<Message> came = sut.take(1, kEnd);
  ASSERT_EQ(came.size(), 2U);
  EXPECT_EQ(came[0].kind, Kind::Catalogue);
  EXPECT_EQ(came[1].body[0], 2) << "the frame of meanwhile";
}

TEST_F(NetworkTest, A_cable_that_is_back_within_the_lease_was_never_away) {
  SimulatedNetwork sut({.delay = 1ms, .lease = 50ms}, 2);
  sut.cut(0, 10 * kMs);
  sut.join(0, 20 * kMs);
  EXPECT_TRUE(sut.take(1, kEnd).empty());
}

TEST_F(NetworkTest, A_board_that_leaves_is_gone_at_once_and_one_that_starts_hears_who_is_there) {
  SimulatedNetwork sut({.delay = 1ms, .lease = 50ms}, 2);
  sut.send(message(Kind::Catalogue, 1, 0));
  (void)sut.take(0, kMs);
  sut.leave(0, 10 * kMs);
  EXPECT_EQ(sut.next_question(1), 11 * kMs);
  EXPECT_EQ(sut.take(1, kEnd).at(0).kind, Kind::Gone);
  sut.start(0, 20 * kMs);
  EXPECT_EQ(sut.take(0, kEnd).at(0).kind, Kind::Catalogue);
}

}  // namespace
}  // namespace indurop::mirror
