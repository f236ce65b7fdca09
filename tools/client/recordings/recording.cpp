// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recordings/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "core/base/csv_row.h"
#include "core/base/json.h"

namespace indurop::tools {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostElements = 64;  // maximum elements of an array
constexpr std::size_t kMostSteps = 8;      // maximum different values of a lane

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = code == std::errc() && end == text.data() + text.size();
  return whole ? std::optional(value) : std::nullopt;
}

double word(Series& series, const std::string& text) {
  auto found = std::find(series.words.begin(), series.words.end(), text);
  if (found == series.words.end()) {
    found = series.words.insert(found, text);
  }
  return static_cast<double>(found - series.words.begin());
}

std::vector<double> values(Series& series, const std::string& field) {
  if (field.empty()) {
    return {};
  }
  if (field.front() == '[') {
    std::vector<double> out;
    const auto list = base::Json::parse(field).value_or(base::Json());
    for (const base::Json& each : list.values().first(std::min(list.values().size(), kMostElements))) {
      const auto yes = each.boolean();
      out.push_back(yes ? (*yes ? 1.0 : 0.0) : each.number().value_or(kNone));
    }
    return out;
  }
  if (field == "true" || field == "false") {
    return {field == "true" ? 1.0 : 0.0};
  }
  const auto value = number(field);
  return {value && series.words.empty() ? *value : word(series, field)};
}

void append(Series& series, const std::string& field, std::size_t rows_before) {
  const std::vector<double> now = values(series, field);
  if (series.lines.size() < now.size()) {
    series.lines.resize(now.size(), std::vector<double>(rows_before, kNone));
  }
  for (std::size_t i = 0; i < series.lines.size(); ++i) {
    series.lines[i].push_back(i < now.size() ? now[i] : kNone);
  }
}

// One row is what a recording has of values that did not change. They are drawn as lines of one second.
void hold(Recording& recording) {
  recording.time_s.push_back(recording.time_s.front() + 1);
  for (Series& series : recording.series) {
    for (std::vector<double>& line : series.lines) {
      line.push_back(line.front());
    }
  }
}

}  // namespace

bool few_whole_values(const std::vector<double>& line) {
  std::set<double> seen;
  for (const double value : line) {
    if (!std::isnan(value) && (value != std::floor(value) || (seen.insert(value).second && seen.size() > kMostSteps))) {
      return false;
    }
  }
  return true;
}

Result<Recording, base::Diagnostic> read_recording(std::string_view text, const std::string& name) {
  std::size_t line = 1;
  const auto problem = [&name](std::size_t at, std::string what) {
    return base::Diagnostic{base::Diagnostic::Severity::Error, name, {static_cast<int>(at), 1}, std::move(what)};
  };
  const std::vector<base::CsvCell> heading = base::take_csv_row(text, ',', line);
  const double unit = base::csv_time_unit(heading.front().text);
  if (unit == 0 || heading.size() < 2) {
    return problem(1,
                   "the heading is not that of a recording: first time_ns (or time_us, time_ms, time), then names; "
                   "record with `indurop watch NAME... -o csv`");
  }
  Recording recording;
  for (std::size_t i = 1; i < heading.size(); ++i) {
    recording.series.push_back({heading[i].text, {}, {}, false});
  }
  double first = 0;
  while (!text.empty()) {
    const std::vector<base::CsvCell> cells = base::take_csv_row(text, ',', line);
    if (cells.size() == 1 && cells.front().text.empty()) {
      continue;
    }
    const auto time = number(cells.front().text);
    if (!time || cells.size() != heading.size()) {
      return problem(cells.front().line, time ? fmt::format("{} values for {} columns", cells.size(), heading.size())
                                              : "the first column is not a time");
    }
    first = recording.time_s.empty() ? *time : first;
    for (std::size_t i = 1; i < cells.size(); ++i) {
      append(recording.series[i - 1], cells[i].text, recording.time_s.size());
    }
    recording.time_s.push_back((*time - first) * unit);
  }
  if (recording.time_s.empty()) {
    return problem(line - 1, "there is no row below the heading; record one with `indurop watch NAME... -o csv`");
  }
  if (recording.time_s.size() == 1) {
    hold(recording);
  }
  if (!std::is_sorted(recording.time_s.begin(), recording.time_s.end())) {
    return problem(0, "the times are not rising");
  }
  for (Series& series : recording.series) {
    series.steps = series.lines.size() == 1 && (!series.words.empty() || few_whole_values(series.lines.front()));
  }
  return recording;
}

}  // namespace indurop::tools
