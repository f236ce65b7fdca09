// SPDX-License-Identifier: Apache-2.0
#include "core/base/csv_row.h"

#include <gmock/gmock.h>

#include <random>

namespace indurop::base {
namespace {

using testing::ElementsAre;

std::vector<std::string> texts(std::string_view& text, char separator, std::size_t& line) {
  std::vector<std::string> all;
  for (const CsvCell& cell : take_csv_row(text, separator, line)) {
    all.push_back(cell.text);
  }
  return all;
}

TEST(CsvRow, Cells_may_hold_separators_quotes_and_line_ends_in_quotes) {
  std::string_view text = "a,\"b,\"\"c\"\"\nd\",\r\nnext";
  std::size_t line = 1;
  EXPECT_THAT(texts(text, ',', line), ElementsAre("a", "b,\"c\"\nd", ""));
  EXPECT_EQ(line, 3U);
  EXPECT_EQ(text, "next");
  EXPECT_THAT(texts(text, ',', line), ElementsAre("next"));
  EXPECT_EQ(line, 4U);
}

TEST(CsvRow, Cells_know_where_they_begin) {
  std::string_view text = "x;\"1\n2\";y";
  std::size_t line = 7;
  const auto cells = take_csv_row(text, ';', line);
  ASSERT_EQ(cells.size(), 3U);
  EXPECT_EQ(cells[1].line, 7U);
  EXPECT_EQ(cells[1].column, 3U);
  EXPECT_EQ(cells[2].line, 8U);
  EXPECT_EQ(cells[2].column, 4U);
}

// What a writer that quotes by the RFC makes is read as it was.
TEST(CsvRow, Random_rows_written_by_the_rule_come_back) {
  std::mt19937 random(5);
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::string> row(1 + random() % 5);
    std::string written;
    for (std::size_t i = 0; i < row.size(); ++i) {
      written += i == 0 ? "\"" : ",\"";
      for (std::size_t n = random() % 6; n > 0; --n) {
        const char c = "a,\"\n;b"[random() % 6];
        row[i] += c;
        written += std::string(c == '"' ? 2 : 1, c);
      }
      written += '"';
    }
    written += '\n';
    std::string_view text = written;
    std::size_t line = 1;
    EXPECT_EQ(texts(text, ',', line), row) << written;
    EXPECT_TRUE(text.empty());
  }
}

TEST(CsvRow, Names_of_times_say_their_unit) {
  EXPECT_EQ(csv_time_unit("time"), 1);
  EXPECT_EQ(csv_time_unit("time_ns"), 1e-9);
  EXPECT_EQ(csv_time_unit("times"), 0);
}

}  // namespace
}  // namespace indurop::base
