// SPDX-License-Identifier: Apache-2.0
// What a replay gives to a process: all of it arrives, or as much as there is room for, and only from its own node.

#include "store/tape/replay_input.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <vector>

#include "store/tape/layout.h"
#include "tests/unit/store/vars/test_schema.h"

namespace indurop::tape {
namespace {

class Retold : public testing::Test {
 protected:
  void expect_arrives(const std::vector<std::int64_t>& readings, const std::vector<ReplayedAnswer>& answers,
                      std::size_t count) {
    sut_.give(readings, answers);
    const auto read = reader_.readings();
    EXPECT_EQ(std::vector<std::int64_t>(read.begin(), read.end()), readings);
    const auto got = reader_.answers();
    ASSERT_EQ(got.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(got[i].code, answers[i].code);
      EXPECT_TRUE(
          std::equal(got[i].bytes.begin(), got[i].bytes.end(), answers[i].bytes.begin(), answers[i].bytes.end()));
    }
  }
  vars::test::TestNode node_{"input"};
  ReplayInputWriter sut_ = ReplayInputWriter::create(node_.name(), 42).value();
  ReplayInputReader reader_ = ReplayInputReader::open(node_.name(), 42).value();
};

TEST_F(Retold, Runs_get_what_is_given) {
  std::mt19937 random(1);
  std::vector<std::uint8_t> bytes(1000);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(random());
  }
  for (int run = 0; run < 100; ++run) {
    std::vector<std::int64_t> readings(random() % (kMaxReadings + 1U));
    std::generate(readings.begin(), readings.end(), [&] { return static_cast<std::int64_t>(random()); });
    std::vector<ReplayedAnswer> answers(random() % 100);
    for (ReplayedAnswer& answer : answers) {
      const std::size_t from = random() % bytes.size();
      answer = {-static_cast<std::int64_t>(random()), {bytes.data() + from, random() % (bytes.size() - from)}};
    }
    expect_arrives(readings, answers, answers.size());
  }
  expect_arrives({}, {}, 0);
}

TEST_F(Retold, What_there_is_no_room_for_is_left_out) {
  const std::vector<std::uint8_t> half(500'000, 7);
  expect_arrives({1}, {{1, half}, {2, half}, {3, half}}, 2);
  const std::vector<std::uint8_t> whole(2'000'000, 7);
  expect_arrives({1}, {{1, whole}}, 0);
}

TEST_F(Retold, No_other_process_receives) {
  EXPECT_EQ(ReplayInputReader::open(node_.name(), 43).error().code, Errc::NotFound);
  EXPECT_EQ(ReplayInputReader::open(node_.name() + "x", 42).error().code, Errc::NotFound);
  sut_ = ReplayInputWriter::create(node_.name() + "y", 42).value();
  EXPECT_EQ(ReplayInputReader::open(node_.name(), 42).error().code, Errc::NotFound) << "its memory is gone";
}

}  // namespace
}  // namespace indurop::tape
