// SPDX-License-Identifier: Apache-2.0
// Two signals in one picture: which columns differ, judged by what holds at each time.

#include "tools/cli/recordings/replayed_over.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

namespace indurop::tools {
namespace {

using Signal = std::map<int, int>;  // value from a time on

std::string csv(const std::map<std::string, Signal>& signals, const std::string& prefix) {
  std::set<int> times;
  std::string text = "time_ns";
  for (const auto& [name, signal] : signals) {
    text += "," + prefix + name;
    for (const auto& [time, value] : signal) {
      times.insert(time);
    }
  }
  text += "\n";
  for (const int time : times) {
    text += std::to_string(time * 1000000);
    for (const auto& [name, signal] : signals) {
      const auto after = signal.upper_bound(time);
      text += "," + (after == signal.begin() ? "" : std::to_string(std::prev(after)->second));
    }
    text += "\n";
  }
  return text;
}

TEST(ReplayedOver, Shows_each_column_that_differs_and_no_other) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    std::map<std::string, Signal> then;
    std::map<std::string, Signal> now;
    std::set<std::string> differing;
    for (int i = 0; i < 6; ++i) {
      const std::string name = "x" + std::to_string(i);
      for (int k = 0; k < 30; ++k) {
        then[name][k] = static_cast<int>(random() % 50);
      }
      now[name] = then[name];
      if (random() % 2 == 0) {
        const int at = static_cast<int>(random() % 30);
        now[name][at] += 1;
        differing.insert(name);
      }
    }
    std::size_t left_out = 0;
    const auto sut = laid_over(csv(then, "b/"), "b/", csv(now, ""), left_out);
    ASSERT_TRUE(sut.ok()) << sut.error().text;
    std::set<std::string> shown;
    for (const Series& series : sut->series) {
      shown.insert(series.name);
      ASSERT_EQ(series.lines.size(), 2U);
      int apart = 0;
      for (std::size_t i = 0; i < series.lines[0].size(); ++i) {
        EXPECT_EQ(series.lines[0][i], then[series.name][static_cast<int>(i)]);
        apart += series.lines[0][i] != series.lines[1][i] ? 1 : 0;
      }
      EXPECT_EQ(apart, 1);
    }
    EXPECT_EQ(shown, differing);
    EXPECT_EQ(left_out, 0U);
  }
}

TEST(ReplayedOver, Columns_of_few_values_are_two_lanes_and_there_is_room_for_twenty) {
  std::map<std::string, Signal> then;
  std::map<std::string, Signal> now;
  for (int i = 10; i < 35; ++i) {
    then["x" + std::to_string(i)] = {{0, 0}, {5, 1}};
    now["x" + std::to_string(i)] = {{0, 0}, {6, 1}};
  }
  std::size_t left_out = 0;
  const auto sut = laid_over(csv(then, ""), "", csv(now, ""), left_out);
  ASSERT_TRUE(sut.ok()) << sut.error().text;
  EXPECT_EQ(left_out, 5U);
  ASSERT_EQ(sut->series.size(), 40U);
  EXPECT_EQ(sut->series[0].name, "x10");
  EXPECT_EQ(sut->series[1].name, "now");
  EXPECT_TRUE(sut->series[1].steps);
}

TEST(ReplayedOver, Other_files_are_refused) {
  std::size_t left_out = 0;
  EXPECT_FALSE(laid_over("time_ns,a\nnever,1\n", "", "time_ns,a\n1,1\n", left_out).ok());
  EXPECT_FALSE(laid_over("time_ns,a\n1,1,2\n", "", "time_ns,a\n1,1\n", left_out).ok());
}

}  // namespace
}  // namespace indurop::tools
