// SPDX-License-Identifier: Apache-2.0
#include "io/csv_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>

#include "base/diagnostics.h"
#include "base/text.h"

namespace indurop::io {
namespace {

constexpr std::size_t kMostProblems = 20;
constexpr double kMostSeconds = 9e9;

struct Cell {
  std::string text;
  std::size_t column;  // from 1
};

class Reader {
 public:
  explicit Reader(const std::string& file) : problems_(file, found_, kMostProblems) {}

  Result<CsvTable, std::vector<base::Diagnostic>> read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) {
      text.remove_prefix(3);
    }
    while (!text.empty() && !problems_.full()) {
      ++line_;
      const std::size_t end = text.find('\n');
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
      const std::string_view content = base::trimmed(line);
      if (content.empty() || content.front() == '#') {
        continue;
      }
      if (!has_header_) {
        read_header(line);
      } else if (unit_ > 0) {
        read_row(split(line));
      }
    }
    if (!has_header_) {
      line_ = 1;
      problem(1, "the file has no row of names; the first row is time and one name per column");
    } else if (unit_ > 0 && table_.rows.empty() && !problems_.failed()) {
      problem(1, "the file has no values; add a row for each time");
    }
    if (problems_.failed()) {
      return std::move(found_);
    }
    return std::move(table_);
  }

 private:
  void problem(std::size_t column, const std::string& text) {
    problems_.error({static_cast<int>(line_), static_cast<int>(column)}, text);
  }

  [[nodiscard]] std::vector<Cell> split(std::string_view line) const {
    std::vector<Cell> cells{{"", 1}};
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '"') {
        quoted = !quoted;
      } else if (line[i] == separator_ && !quoted) {
        cells.push_back({"", i + 2});
      } else {
        cells.back().text += line[i];
      }
    }
    for (Cell& cell : cells) {
      cell.text = base::trimmed(cell.text);
    }
    return cells;
  }

  void read_header(std::string_view line) {
    has_header_ = true;
    separator_ = line.find(';') != std::string_view::npos ? ';' : ',';
    const std::vector<Cell> cells = split(line);
    const std::string& time = cells.front().text;
    constexpr double kMilli = 1e-3;
    constexpr double kMicro = 1e-6;
    unit_ = time == "time" || time == "time_s" ? 1 : time == "time_ms" ? kMilli : time == "time_us" ? kMicro : 0;
    if (unit_ == 0) {
      problem(1,
              fmt::format("the first column is called '{}'; it must be time (in seconds), time_ms or time_us", time));
    }
    std::set<std::string> seen;
    for (std::size_t i = 1; i < cells.size(); ++i) {
      if (cells[i].text.empty()) {
        problem(cells[i].column, "this column has no name; give it one");
      } else if (!seen.insert(cells[i].text).second) {
        problem(cells[i].column, fmt::format("a second column '{}'; names are unique", cells[i].text));
      }
      table_.columns.push_back(cells[i].text);
    }
  }

  bool number(const Cell& cell, double& value) {
    const char* first = cell.text.data();
    const char* last = first + cell.text.size();
    first += cell.text.starts_with('+') ? 1 : 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc{} || end != last || !std::isfinite(value)) {
      problem(cell.column, fmt::format("'{}' is not a number; leave the cell empty if there is no value", cell.text));
      return false;
    }
    return true;
  }

  void read_row(const std::vector<Cell>& cells) {
    if (cells.size() != table_.columns.size() + 1) {
      problem(cells.back().column,
              fmt::format("{} cells, the first row has {}", cells.size(), table_.columns.size() + 1));
      return;
    }
    CsvRow row;
    double time = 0;
    if (!number(cells.front(), time)) {
      return;
    }
    constexpr double kNanos = 1e9;
    const double seconds = time * unit_;
    if (seconds < 0 || seconds > kMostSeconds) {
      problem(1, fmt::format("time {} is not possible; times begin at 0", cells.front().text));
      return;
    }
    row.time_ns = static_cast<std::int64_t>(std::llround(seconds * kNanos));
    if (!table_.rows.empty() && row.time_ns <= table_.rows.back().time_ns) {
      problem(1, fmt::format("time {} is not after that of the row before; sort the rows by time", cells.front().text));
      return;
    }
    for (std::size_t i = 1; i < cells.size(); ++i) {
      double value = std::numeric_limits<double>::quiet_NaN();
      if (!cells[i].text.empty() && !number(cells[i], value)) {
        value = 0;
      }
      row.values.push_back(value);
    }
    table_.rows.push_back(std::move(row));
  }

  std::vector<base::Diagnostic> found_;
  base::Diagnostics problems_;
  CsvTable table_;
  std::size_t line_ = 0;
  char separator_ = ',';
  double unit_ = 0;  // seconds per unit of the time column
  bool has_header_ = false;
};

}  // namespace

Result<CsvTable, std::vector<base::Diagnostic>> read_csv(std::string_view text, const std::string& file) {
  return Reader(file).read(text);
}

}  // namespace indurop::io
