// SPDX-License-Identifier: Apache-2.0
// Age of values against counting releases one by one, circles, and the order that puts writers first.

#include "config/check/data_flow.h"

#include <gmock/gmock.h>

#include <numeric>
#include <random>

namespace indurop::config {
namespace {

using testing::ElementsAre;

// Every release of the reader over two common multiples, after the first in which the writer has run.
Age counted(const Release& writer, const Release& reader) {
  const std::int64_t common = std::lcm(writer.period.count(), reader.period.count());
  Age age{base::Nanos::max(), base::Nanos::min(), false, 0};
  for (std::int64_t r = reader.offset.count() + common; r < 3 * common; r += reader.period.count()) {
    std::int64_t last = -1;
    for (std::int64_t w = writer.offset.count(); w <= r; w += writer.period.count()) {
      const bool before = w < r || writer.position < reader.position;
      last = before ? w : last;
      age.meet = age.meet || w == r;
    }
    age.least = std::min(age.least, base::Nanos(r - last));
    age.most = std::max(age.most, base::Nanos(r - last));
  }
  return age;
}

// Two nodes are in one group if each can be reached from the other; its number is that of its smallest node.
std::vector<std::size_t> circles_by_reaching(std::size_t count, const std::vector<Edge>& edges) {
  std::vector<std::vector<bool>> reach(count, std::vector<bool>(count, false));
  for (const auto& [from, to] : edges) {
    reach[from][to] = true;
  }
  for (std::size_t via = 0; via < count; ++via) {
    for (std::size_t from = 0; from < count; ++from) {
      for (std::size_t to = 0; to < count; ++to) {
        reach[from][to] = reach[from][to] || (reach[from][via] && reach[via][to]);
      }
    }
  }
  std::vector<std::size_t> group;
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t smallest = 0;
    while (smallest != i && !(reach[i][smallest] && reach[smallest][i])) {
      ++smallest;
    }
    group.push_back(smallest);
  }
  return group;
}

TEST(Circles, Hold_what_can_be_reached_both_ways) {
  std::mt19937 random(7);
  for (int round = 0; round < 500; ++round) {
    const std::size_t count = 1 + random() % 12;
    std::vector<Edge> edges(random() % (2 * count));
    for (Edge& edge : edges) {
      edge = {random() % count, random() % count};
    }
    ASSERT_EQ(circles(count, edges), circles_by_reaching(count, edges)) << "round " << round;
  }
}

TEST(Age, Agrees_with_counting) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> any(1, 15);
  for (int round = 0; round < 2'000; ++round) {
    Release writer{base::Nanos(any(random)), base::Nanos(0), 0};
    Release reader{base::Nanos(any(random)), base::Nanos(0), 1};
    writer.offset = base::Nanos(any(random) % writer.period.count());
    reader.offset = base::Nanos(any(random) % reader.period.count());
    if (round % 2 == 0) {
      std::swap(writer.position, reader.position);
    }
    const Age expected = counted(writer, reader);
    const Age sut = age_between(writer, reader);
    ASSERT_EQ(sut.least, expected.least) << writer.period.count() << " " << reader.period.count();
    ASSERT_EQ(sut.most, expected.most);
    ASSERT_EQ(sut.meet, expected.meet);
  }
}

TEST(Age, Reader_behind_writer_of_the_same_period_reads_the_value_of_now) {
  const Age sut = age_between({base::Nanos(10), base::Nanos(0), 0}, {base::Nanos(10), base::Nanos(0), 1});
  EXPECT_EQ(sut.least, base::Nanos(0));
  EXPECT_EQ(sut.most, base::Nanos(0));
}

TEST(Circles, Nodes_that_feed_each_other_form_a_group) {
  const auto sut = circles(5, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}});
  EXPECT_EQ(sut[0], sut[1]);
  EXPECT_EQ(sut[1], sut[2]);
  EXPECT_NE(sut[2], sut[3]);
  EXPECT_NE(sut[3], sut[4]);
}

TEST(Writers_first, Sensor_control_motor_whatever_order_they_come_in) {
  // 0 = control, 1 = motor, 2 = sensor
  EXPECT_THAT(writers_first(3, {{2, 0}, {0, 1}}), ElementsAre(2, 0, 1));
  EXPECT_THAT(writers_first(3, {}), ElementsAre(0, 1, 2));
}

TEST(Writers_first, Circles_keep_their_order_and_lose_no_module) {
  EXPECT_THAT(writers_first(4, {{0, 1}, {1, 0}, {3, 0}}), ElementsAre(1, 2, 3, 0));
  EXPECT_THAT(writers_first(2, {{0, 1}, {1, 0}}), ElementsAre(0, 1));
}

}  // namespace
}  // namespace indurop::config
