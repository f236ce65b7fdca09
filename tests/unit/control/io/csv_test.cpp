// SPDX-License-Identifier: Apache-2.0
// Recorded values: reading the file, and what counts when.
#include <gmock/gmock.h>

#include <cmath>

#include "config/check/csv_table.h"
#include "control/io/csv_driver.h"

namespace indurop::io {
namespace {

using config::CsvTable;
using config::read_csv;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;

CsvTable read(std::string_view text) {
  auto table = read_csv(text, "in.csv");
  EXPECT_TRUE(table.ok()) << (table.ok() ? "" : base::to_text(table.error()));
  return table.ok() ? *table : CsvTable{};
}

std::vector<std::string> problems_of(std::string_view text) {
  std::vector<std::string> lines;
  if (const auto table = read_csv(text, "in.csv"); !table.ok()) {
    for (const base::Diagnostic& each : table.error()) {
      lines.push_back(base::to_string(each));
    }
  }
  return lines;
}

TEST(Csv, Reads_names_times_and_numbers) {
  const CsvTable sut = read("\xEF\xBB\xBF# recorded\ntime_ms, a ,\"b,c\"\r\n\n0,1,-2.5\n0.5,+1e3,\n");
  EXPECT_THAT(sut.columns, ElementsAre("a", "b,c"));
  ASSERT_EQ(sut.rows.size(), 2U);
  EXPECT_EQ(sut.rows[1].time_ns, 500'000);
  EXPECT_EQ(sut.rows[1].values[0], 1000);
  EXPECT_TRUE(std::isnan(sut.rows[1].values[1]));
}

TEST(Csv, Semicolons_separate_where_the_first_row_has_them) {
  EXPECT_EQ(read("time;a\n0;1\n2;3\n").rows[1].time_ns, 2'000'000'000);
}

TEST(Csv, Says_everything_that_is_wrong_with_its_place) {
  const auto problems = problems_of("time,a,a,\n0,x,1,2\n0,1,2,3\n1,2\n-1,0,0,0\nsoon,0,0,0\n");
  EXPECT_THAT(problems,
              ElementsAre("in.csv:1:8: error: a second column 'a'; names are unique",
                          "in.csv:1:10: error: this column has no name; give it one",
                          "in.csv:2:3: error: 'x' is not a number; leave the cell empty if there is no value",
                          "in.csv:3:1: error: time 0 is not after that of the previous row; sort the rows by time",
                          "in.csv:4:3: error: 2 cells, the first row has 4",
                          "in.csv:5:1: error: time -1 is not possible; times begin at 0",
                          "in.csv:6:1: error: 'soon' is not a number; leave the cell empty if there is no value"));
}

TEST(Csv, Wants_a_time_and_values) {
  const auto problem = [](std::string_view text) {
    const auto problems = problems_of(text);
    return problems.empty() ? "" : problems.front();
  };
  EXPECT_THAT(problem("a,b\n1,2\n"), HasSubstr("in.csv:1:1: error: the first column is called 'a'; it must be time"));
  EXPECT_THAT(problem(""), HasSubstr("in.csv:1:1: error: the file has no row of names"));
  EXPECT_THAT(problem("time,a\n"), HasSubstr("in.csv:1:1: error: the file has no values"));
}

struct Seen {
  double value;
  Quality quality;
  bool operator==(const Seen& other) const { return value == other.value && quality == other.quality; }
};

std::vector<Seen> replay(std::string_view text, bool loop, int steps) {
  CsvDriver sut(read(text), {0}, loop);
  std::vector<Sample> inputs(1);
  std::vector<Seen> seen;
  for (int i = 0; i < steps; ++i) {
    EXPECT_EQ(sut.exchange({}, inputs, milliseconds(10)), Driver::Outcome::Good);
    seen.push_back({static_cast<double>(inputs[0].value), inputs[0].quality});
  }
  return seen;
}

TEST(CsvReplay, A_row_counts_from_its_time_until_the_next) {
  EXPECT_THAT(replay("time_ms,a\n10,1\n30,2\n", false, 6),
              ElementsAre(Seen{0, Quality::None}, Seen{1, Quality::Good}, Seen{1, Quality::Good},
                          Seen{2, Quality::Good}, Seen{2, Quality::Good}, Seen{2, Quality::Good}));
}

TEST(CsvReplay, An_empty_cell_is_a_bad_value) {
  EXPECT_THAT(replay("time_ms,a\n0,1\n10,\n20,3\n", false, 3),
              ElementsAre(Seen{1, Quality::Good}, Seen{1, Quality::Lost}, Seen{3, Quality::Good}));
}

TEST(CsvReplay, A_loop_begins_again_after_the_last_row) {
  const auto seen = replay("time_ms,a\n0,1\n10,2\n20,3\n", true, 7);
  std::vector<double> values;
  for (const Seen& s : seen) {
    values.push_back(s.value);
  }
  EXPECT_THAT(values, ElementsAre(1, 2, 3, 1, 2, 3, 1));
}

TEST(CsvReplay, A_period_longer_than_the_file_is_fine) {
  CsvDriver sut(read("time_ms,a\n0,1\n1,2\n"), {0}, true);
  std::vector<Sample> inputs(1);
  for (int i = 0; i < 5; ++i) {
    sut.exchange({}, inputs, milliseconds(7));
    EXPECT_EQ(static_cast<double>(inputs[0].value), i * 7 % 2 == 0 ? 1 : 2) << i;
  }
}

}  // namespace
}  // namespace indurop::io
