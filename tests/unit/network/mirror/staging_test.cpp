// SPDX-License-Identifier: Apache-2.0
#include "network/mirror/frames/staging.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

namespace indurop::mirror {
namespace {

using Verdict = Staging::Verdict;
constexpr std::int64_t kStagingMs = 1'000'000;

class StagingOf : public ::testing::Test {
 protected:
  explicit StagingOf() { sut_.reset(std::array<std::uint32_t, 3>{1, 1, 1}); }
  Verdict arrived(std::uint32_t part, std::uint64_t update, std::uint64_t sum, std::uint8_t value,
                  std::int64_t now = 0) {
    return sut_.arrived(part, update, sum, {&value, 1}, now);
  }
  std::map<std::uint32_t, int> taken() {
    std::map<std::uint32_t, int> values;
    sut_.take([&](std::uint32_t part, std::span<const std::uint8_t> data) { values[part] = data[0]; });
    return values;
  }
  using Values = std::map<std::uint32_t, int>;
  Staging sut_;
};

TEST_F(StagingOf, One_part_is_an_update) {
  EXPECT_EQ(arrived(0, 1, 1, 10), Verdict::Whole);
  EXPECT_EQ(taken(), (Values{{0, 10}}));
  EXPECT_EQ(taken(), Values{});
}

TEST_F(StagingOf, Parts_wait_for_the_others_of_their_update) {
  EXPECT_EQ(arrived(0, 1, 3, 10), Verdict::Wait);
  EXPECT_EQ(arrived(2, 1, 3, 12), Verdict::Wait);
  EXPECT_EQ(arrived(1, 1, 3, 11), Verdict::Whole);
  EXPECT_EQ(taken(), (Values{{0, 10}, {1, 11}, {2, 12}}));
}

TEST_F(StagingOf, An_update_of_some_parts_only_is_whole_without_the_rest) {
  for (std::uint32_t part : {0U, 1U, 2U}) {
    arrived(part, 1, 3, 1);
  }
  (void)taken();
  EXPECT_EQ(arrived(0, 2, 5, 2), Verdict::Wait);
  EXPECT_EQ(arrived(2, 2, 5, 2), Verdict::Whole);
  EXPECT_EQ(taken(), (Values{{0, 2}, {2, 2}}));
}

TEST_F(StagingOf, A_lost_part_is_noticed_although_the_next_update_is_complete) {
  arrived(0, 1, 2, 1);
  EXPECT_EQ(arrived(1, 1, 2, 1), Verdict::Whole);
  (void)taken();
  // Update 2 is part 1 only, and lost; update 3 is part 0 only.
  EXPECT_EQ(arrived(0, 3, 5, 3), Verdict::Wait);
  EXPECT_EQ(arrived(1, 2, 3, 2), Verdict::Whole) << "it is repeated";
  EXPECT_EQ(taken(), (Values{{0, 3}, {1, 2}}));
}

TEST_F(StagingOf, The_latest_of_each_part_counts) {
  arrived(0, 1, 2, 1);
  EXPECT_EQ(arrived(0, 2, 4, 2), Verdict::Wait);
  EXPECT_EQ(arrived(0, 1, 2, 1), Verdict::Old);
  EXPECT_EQ(arrived(1, 2, 4, 2), Verdict::Whole);
  EXPECT_EQ(taken(), (Values{{0, 2}, {1, 2}}));
}

TEST_F(StagingOf, Patience_ends) {
  EXPECT_EQ(arrived(0, 1, 2, 1, 1 * kStagingMs), Verdict::Wait);
  EXPECT_EQ(arrived(0, 2, 4, 2, 1 * kStagingMs + Staging::kPatienceNs), Verdict::Overdue);
  EXPECT_EQ(taken(), (Values{{0, 2}}));
  EXPECT_EQ(arrived(1, 2, 4, 2, 20 * kStagingMs), Verdict::Whole);
  EXPECT_EQ(arrived(0, 3, 6, 3, 30 * kStagingMs), Verdict::Wait) << "the time limit begins again";
}

TEST_F(StagingOf, Parts_without_a_local_reader_are_counted_too) {
  sut_.reset(std::array<std::uint32_t, 2>{1, 0});
  EXPECT_EQ(arrived(0, 1, 2, 1), Verdict::Wait);
  EXPECT_EQ(arrived(1, 1, 2, 9), Verdict::Whole);
  EXPECT_EQ(taken(), (Values{{0, 1}}));
}

TEST_F(StagingOf, A_new_session_begins_with_nothing) {
  arrived(0, 9, 20, 1);
  sut_.reset(std::array<std::uint32_t, 1>{1});
  EXPECT_EQ(taken(), Values{});
  EXPECT_EQ(arrived(0, 1, 1, 2), Verdict::Whole);
}

// Whatever is lost, doubled or late: what is called whole is the sender's state after one of its updates.
TEST_F(StagingOf, What_is_whole_is_one_state_of_the_sender) {
  constexpr std::uint32_t kParts = 5;
  std::mt19937 random(1);
  sut_.reset(std::array<std::uint32_t, kParts>{1, 1, 1, 1, 1});
  std::array<std::uint64_t, kParts> sent{};
  std::array<std::uint8_t, kParts> state{};
  std::map<std::array<std::uint8_t, kParts>, std::uint64_t> states;  // after which update
  std::array<std::uint8_t, kParts> here{};
  int whole = 0;
  for (std::uint64_t update = 1; update <= 250; ++update) {
    std::vector<std::uint32_t> parts;
    for (std::uint32_t part = 0; part < kParts; ++part) {
      if (random() % 3 != 0) {
        parts.push_back(part);
        sent[part] = update;
        state[part] = static_cast<std::uint8_t>(update);
      }
    }
    states[state] = update;
    const std::uint64_t sum = sent[0] + sent[1] + sent[2] + sent[3] + sent[4];
    std::shuffle(parts.begin(), parts.end(), random);
    for (const std::uint32_t part : parts) {
      if (random() % 10 == 0) {
        continue;  // lost
      }
      const Verdict verdict = arrived(part, update, sum, static_cast<std::uint8_t>(update));
      if (verdict == Verdict::Whole) {
        for (const auto& [number, value] : taken()) {
          here[number] = static_cast<std::uint8_t>(value);
        }
        ++whole;
        EXPECT_TRUE(states.contains(here)) << "update " << update;
      }
    }
  }
  EXPECT_GT(whole, 50);
}

}  // namespace
}  // namespace indurop::mirror
