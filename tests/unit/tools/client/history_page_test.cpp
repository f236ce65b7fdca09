// SPDX-License-Identifier: Apache-2.0
// Pages of a history: however it is split, and however its sources are, together they are the same changes.

#include "tools/client/history/history_page.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace indurop::tools {
namespace {

constexpr std::uint32_t kItems = 3;

HistoryValue value(std::int64_t time_ns, std::uint32_t item, std::uint8_t byte) {
  return {time_ns, item, {byte}};
}

HistoryPosition start_at(std::int64_t time_ns) {
  HistoryPosition position;
  position.at_ns = time_ns;
  position.seen.resize(kItems);
  return position;
}

// What the sources know between two times: values, many of them repeated, and gaps without values.
HistoryFindings findings(const std::vector<HistoryValue>& all, const std::vector<HistoryGap>& gaps,
                         const TimeSpan& span) {
  HistoryFindings found;
  found.complete_ns = span.end_ns;
  for (const HistoryValue& one : all) {
    if (span.has(one.time_ns)) {
      found.values.push_back(one);
    }
  }
  for (const HistoryGap& one : gaps) {
    if (const TimeSpan cut = one.span.cut_to(span); !cut.empty()) {
      found.gaps.push_back({one.item, cut});
    }
  }
  return found;
}

std::string text_of(const HistoryPage& page) {
  std::string text;
  for (const HistoryValue& one : page.values) {
    text +=
        std::to_string(one.time_ns) + ":" + std::to_string(one.item) + "=" + std::to_string(one.bytes.front()) + " ";
  }
  return text;
}

TEST(HistoryPages, Are_together_the_same_changes_however_they_are_split) {
  std::mt19937 random(5);
  const auto any = [&random](int below) { return static_cast<int>(random() % static_cast<unsigned>(below)); };
  for (int round = 0; round < 300; ++round) {
    constexpr std::int64_t kEnd = 100;
    std::vector<HistoryGap> gaps;
    for (std::uint32_t item = 0; item < kItems; ++item) {
      const std::int64_t begin = any(kEnd);
      gaps.push_back({item, {begin, begin + any(20)}});
    }
    std::vector<HistoryValue> all;
    for (std::int64_t time = 0; time < kEnd; ++time) {
      for (std::uint32_t item = 0; item < kItems; ++item) {
        if (any(3) == 0 && !gaps[item].span.has(time)) {
          all.push_back(value(time, item, static_cast<std::uint8_t>(any(3))));
        }
      }
    }
    PageBuilder whole(start_at(0), 0, {1'000'000, 1'000'000});
    ASSERT_TRUE(whole.add(findings(all, gaps, {0, kEnd})));
    const std::string expected = text_of(whole.finish(false));

    std::string text;
    HistoryPosition position = start_at(0);
    int pages = 0;
    for (bool more = true; more; ++pages) {
      ASSERT_LT(pages, 1000);
      const std::int64_t from = position.at_ns;
      PageBuilder page(position, from, {static_cast<std::size_t>(1 + any(6)), 1'000'000});
      more = false;
      for (std::int64_t at = from; at < kEnd && !more;) {
        const std::int64_t end = std::min<std::int64_t>(at + 1 + any(30), kEnd);
        more = !page.add(findings(all, gaps, {at, end}));
        at = end;
      }
      HistoryPage finished = page.finish(more);
      text += text_of(finished);
      if (more) {
        const auto again = history_position(to_text(*finished.next), kItems);
        ASSERT_TRUE(again);
        position = *again;
      }
    }
    EXPECT_EQ(text, expected) << round;
  }
}

TEST(HistoryPages, Have_the_last_value_before_their_begin) {
  PageBuilder sut(start_at(0), 10, {100, 100});
  const std::vector<HistoryValue> all{value(3, 0, 1), value(7, 0, 2), value(8, 1, 4), value(12, 0, 2), value(15, 0, 3)};
  const std::vector<HistoryGap> gaps{{1, {9, 11}}};
  EXPECT_TRUE(sut.add(findings(all, gaps, {0, 10})));
  EXPECT_TRUE(sut.add(findings(all, gaps, {10, 20})));
  const HistoryPage page = sut.finish(false);
  ASSERT_TRUE(page.before[0]);
  EXPECT_EQ(page.before[0]->time_ns, 7);
  EXPECT_FALSE(page.before[1]) << "a gap came after it";
  EXPECT_EQ(text_of(page), "15:0=3 ") << "an unchanged value is no change";
  ASSERT_EQ(page.gaps.size(), 1U);
  EXPECT_EQ(page.gaps.front().span, (TimeSpan{10, 11}));
  EXPECT_EQ(page.end_ns, 20);
}

TEST(HistoryPages, Keep_values_of_one_time_together) {
  PageBuilder sut(start_at(0), 0, {2, 100});
  const std::vector<HistoryValue> all{value(1, 0, 1), value(1, 1, 1), value(1, 2, 1), value(2, 0, 2)};
  EXPECT_FALSE(sut.add(findings(all, {}, {0, 10})));
  const HistoryPage page = sut.finish(true);
  EXPECT_EQ(page.values.size(), 3U);
  ASSERT_TRUE(page.next);
  EXPECT_EQ(page.next->at_ns, 2);
}

TEST(HistoryPositions, Of_other_texts_are_refused) {
  const HistoryPosition position{1'764'000'000'000'000'123, -5, {1, 0, UINT64_MAX}};
  const std::string text = to_text(position);
  const auto again = history_position(text, kItems);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->at_ns, position.at_ns);
  EXPECT_EQ(again->real_minus_node_ns, position.real_minus_node_ns);
  EXPECT_EQ(again->seen, position.seen);
  EXPECT_FALSE(history_position(text, kItems - 1));
  EXPECT_FALSE(history_position(text, kItems + 1));
  for (const char* wrong : {"", ".", "1", "1.", "1.2", "-1.2.1.0.1", "1.2.1.0.g", "1.2.1.0.1.",
                            "1.2.1.0.11111111111111111", "1x.2.1.0.1", "99999999999999999999.2.1.0.1", "1,2,1,0,1"}) {
    EXPECT_FALSE(history_position(wrong, kItems)) << wrong;
  }
}

}  // namespace
}  // namespace indurop::tools
