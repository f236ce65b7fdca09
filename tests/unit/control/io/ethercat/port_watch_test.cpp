// SPDX-License-Identifier: Apache-2.0
// What is made of the counters of a slave's ports, against counts of random errors that a slave's counters of eight
// bits have met.
#include "control/io/ethercat/master/port_watch.h"

#include <gmock/gmock.h>

#include <random>

namespace indurop::io::ethercat {
namespace {

constexpr std::size_t kBytes = 0x14;
constexpr std::size_t kLostLinksAt = 0x10;

// Counters that stand still at their maximum, and that a write clears.
struct CountingSlave {
  std::array<std::uint8_t, kBytes> counters{};
  void count(std::size_t at, unsigned times) {
    counters[at] = static_cast<std::uint8_t>(std::min(255U, counters[at] + times));
  }
  std::optional<PortWatch::Finding> answer(PortWatch& watch, const Query& query) {
    if (query.command == Command::Fpwr) {
      counters.fill(0);
      return watch.answer({});
    }
    return watch.answer(counters);
  }
};

TEST(PortWatch, What_was_counted_before_says_nothing) {
  PortWatch sut;
  CountingSlave slave;
  slave.count(2, 7);
  sut.begin(Clock(0));
  ASSERT_TRUE(sut.is_due(Clock(0)));
  EXPECT_FALSE(slave.answer(sut, sut.query(0x1001, Clock(0))));
  EXPECT_FALSE(sut.is_due(std::chrono::milliseconds(999)));
  EXPECT_TRUE(sut.is_due(std::chrono::seconds(1)));
  EXPECT_EQ(sut.errors(), 0U);
}

TEST(PortWatch, Errors_by_which_a_slave_was_lost_are_found_when_it_is_back) {
  PortWatch sut;
  CountingSlave slave;
  sut.begin(Clock(0));
  EXPECT_FALSE(slave.answer(sut, sut.query(0x1001, Clock(0))));
  slave.count(2, 9);
  sut.begin(std::chrono::milliseconds(300));
  const auto found = slave.answer(sut, sut.query(0x1001, std::chrono::milliseconds(300)));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->port, 1);
  EXPECT_EQ(found->broken_frames, 9);
  slave.counters.fill(0);  // its power was off
  sut.begin(std::chrono::seconds(2));
  EXPECT_FALSE(slave.answer(sut, sut.query(0x1001, std::chrono::seconds(2))));
}

TEST(PortWatch, Names_the_port_with_the_most_errors) {
  PortWatch sut;
  CountingSlave slave;
  sut.begin(Clock(0));
  EXPECT_FALSE(slave.answer(sut, sut.query(0x1001, Clock(0))));
  slave.count(0, 1);
  slave.count(4, 3);  // port 2: invalid frames
  slave.count(5, 2);  // of which so many were physically broken
  slave.count(kLostLinksAt + 2, 1);
  const auto found = slave.answer(sut, sut.query(0x1001, std::chrono::seconds(1)));
  ASSERT_TRUE(found);
  EXPECT_EQ(found->port, 2);
  EXPECT_EQ(found->broken_frames, 3);
  EXPECT_EQ(found->lost_links, 1);
  EXPECT_EQ(sut.errors(), 5U);
}

TEST(PortWatch, Random_errors_are_all_counted_although_counters_end_at_255) {
  std::mt19937 random(5);
  PortWatch sut;
  CountingSlave slave;
  sut.begin(Clock(0));
  Clock now{0};
  slave.answer(sut, sut.query(0x1001, now));
  std::uint64_t wanted = 0;
  for (int second = 0; second < 2000; ++second) {
    now += std::chrono::seconds(1);
    if (random() % 4 == 0) {
      const auto times = static_cast<unsigned>(random() % 100);
      slave.count(2 * (random() % PortWatch::kPorts), times);
      wanted += times;
    }
    while (sut.is_due(now)) {
      slave.answer(sut, sut.query(0x1001, now));
    }
  }
  EXPECT_EQ(sut.errors(), wanted);
}

}  // namespace
}  // namespace indurop::io::ethercat
