// SPDX-License-Identifier: Apache-2.0
#include "config/check/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <set>
#include <utility>

#include "core/base/csv_row.h"
#include "core/base/diagnostics.h"
#include "core/base/read_file.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

constexpr std::size_t kMaxProblems = 20;
constexpr double kMaxSeconds = 9e9;

class Reader {
 public:
  explicit Reader(const std::string& file) : problems_(file, found_, kMaxProblems) {}

  Result<CsvTable, std::vector<base::Diagnostic>> read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) {
      text.remove_prefix(3);
    }
    while (!text.empty() && !problems_.full()) {
      if (skip_empty_line(text)) {
        continue;
      }
      if (!has_header_) {
        separator_ = text.substr(0, text.find('\n')).find(';') != std::string_view::npos ? ';' : ',';
      }
      const std::vector<base::CsvCell> cells = take_row(text);
      if (!has_header_) {
        read_header(cells);
      } else if (unit_ > 0) {
        read_row(cells);
      }
    }
    if (!has_header_) {
      problem({}, "the file has no row of names; the first row is time and one name per column");
    } else if (unit_ > 0 && table_.rows.empty() && !problems_.failed()) {
      problem({"", line_ - 1, 1}, "the file has no values; add a row for each time");
    }
    if (problems_.failed()) {
      return std::move(found_);
    }
    return std::move(table_);
  }

 private:
  void problem(const base::CsvCell& at, const std::string& text) {
    problems_.error({static_cast<int>(at.line), static_cast<int>(at.column)}, text);
  }

  // Returns true if the text began with a line without cells.
  bool skip_empty_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    const std::string_view content = base::trimmed(text.substr(0, end));
    if (!content.empty() && content.front() != '#') {
      return false;
    }
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++line_;
    return true;
  }

  std::vector<base::CsvCell> take_row(std::string_view& text) {
    std::vector<base::CsvCell> cells = base::take_csv_row(text, separator_, line_);
    for (base::CsvCell& cell : cells) {
      cell.text = base::trimmed(cell.text);
    }
    return cells;
  }

  void read_header(const std::vector<base::CsvCell>& cells) {
    has_header_ = true;
    unit_ = base::csv_time_unit(cells.front().text);
    if (unit_ == 0) {
      problem(cells.front(), fmt::format("the first column is called '{}'; it must be time (in seconds), time_ms, "
                                         "time_us or time_ns",
                                         cells.front().text));
    }
    std::set<std::string> seen;
    for (std::size_t i = 1; i < cells.size(); ++i) {
      if (cells[i].text.empty()) {
        problem(cells[i], "this column has no name; give it one");
      } else if (!seen.insert(cells[i].text).second) {
        problem(cells[i], fmt::format("a second column '{}'; names are unique", cells[i].text));
      }
      table_.columns.push_back(cells[i].text);
    }
  }

  bool number(const base::CsvCell& cell, double& value) {
    const char* first = cell.text.data();
    const char* last = first + cell.text.size();
    first += cell.text.starts_with('+') ? 1 : 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc{} || end != last || !std::isfinite(value)) {
      problem(cell, fmt::format("'{}' is not a number; leave the cell empty if there is no value", cell.text));
      return false;
    }
    return true;
  }

  void read_row(const std::vector<base::CsvCell>& cells) {
    if (cells.size() != table_.columns.size() + 1) {
      problem(cells.back(), fmt::format("{} cells, the first row has {}", cells.size(), table_.columns.size() + 1));
      return;
    }
    CsvRow row;
    double time = 0;
    if (!number(cells.front(), time)) {
      return;
    }
    constexpr double kNanos = 1e9;
    const double seconds = time * unit_;
    if (seconds < 0 || seconds > kMaxSeconds) {
      problem(cells.front(), fmt::format("time {} is not possible; times begin at 0", cells.front().text));
      return;
    }
    row.time_ns = static_cast<std::int64_t>(std::llround(seconds * kNanos));
    if (!table_.rows.empty() && row.time_ns <= table_.rows.back().time_ns) {
      problem(cells.front(),
              fmt::format("time {} is not after that of the previous row; sort the rows by time", cells.front().text));
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
  std::size_t line_ = 1;
  char separator_ = ',';
  double unit_ = 0;  // seconds per unit of the time column
  bool has_header_ = false;
};

}  // namespace

Result<CsvTable, std::vector<base::Diagnostic>> read_csv(std::string_view text, const std::string& file) {
  return Reader(file).read(text);
}

Result<CsvSource, std::vector<base::Diagnostic>> read_csv_device(const IoDevice& device,
                                                                 std::span<const IoPoint> inputs) {
  const std::string file = device.csv.file.string();
  const auto text = base::read_file(file);
  if (!text) {
    return std::vector{base::Diagnostic{
        base::Diagnostic::Severity::Error, file, {}, fmt::format("cannot be read: {}", text.error().text)}};
  }
  auto table = read_csv(*text, file);
  if (!table) {
    return std::move(table).error();
  }
  CsvSource source{std::move(table).value(), {}};
  std::vector<base::Diagnostic> missing;
  const auto& names = source.table.columns;
  for (const IoPoint& point : inputs) {
    const auto found = std::find(names.begin(), names.end(), point.at);
    if (found == names.end()) {
      missing.push_back({base::Diagnostic::Severity::Error,
                         file,
                         {1, 1},
                         fmt::format("there is no column '{}'; there are {}", point.at, fmt::join(names, ", "))});
    }
    source.columns.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  if (!missing.empty()) {
    return missing;
  }
  return source;
}

}  // namespace indurop::config
