// SPDX-License-Identifier: Apache-2.0
#include "tools/values/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "base/json.h"

namespace indurop::tools {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostElements = 64;  // of an array
constexpr std::size_t kMostSteps = 8;      // different values of a lane

// Takes one row off the front of `text`; quoted fields may contain commas and line ends.
std::vector<std::string> take_row(std::string_view& text, std::size_t& lines) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    lines += c == '\n' ? 1 : 0;
    if (quoted && c == '"' && at + 1 < text.size() && text[at + 1] == '"') {
      fields.back() += text[++at];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c == '\n' && !quoted) {
      ++at;
      break;
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  text.remove_prefix(at);
  return fields;
}

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

bool few_whole_values(const std::vector<double>& line) {
  std::set<double> seen;
  for (const double value : line) {
    if (!std::isnan(value) && (value != std::floor(value) || (seen.insert(value).second && seen.size() > kMostSteps))) {
      return false;
    }
  }
  return true;
}

// Seconds in one of the time column; 0: it is none.
double time_unit(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, double>, 4> kUnits{
      {{"time_ns", 1e-9}, {"time_us", 1e-6}, {"time_ms", 1e-3}, {"time", 1}}};
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [name](const auto& u) { return u.first == name; });
  return found == kUnits.end() ? 0 : found->second;
}

}  // namespace

std::string read_recording(std::string_view text, const std::string& name, Recording& to) {
  std::size_t line = 1;
  const std::vector<std::string> heading = take_row(text, line);
  const double unit = time_unit(heading.front());
  if (unit == 0 || heading.size() < 2) {
    return fmt::format(
        "{}:1: error: the heading is not that of a recording: first time_ns (or time_us, time_ms, time), then names; "
        "record with `indurop watch NAME... -o csv`",
        name);
  }
  for (std::size_t i = 1; i < heading.size(); ++i) {
    to.series.push_back({heading[i], {}, {}, false});
  }
  double first = 0;
  while (!text.empty()) {
    const std::size_t row = line;
    const std::vector<std::string> fields = take_row(text, line);
    if (fields.size() == 1 && fields.front().empty()) {
      continue;
    }
    const auto time = number(fields.front());
    if (!time || fields.size() != heading.size()) {
      return fmt::format("{}:{}: error: {}", name, row,
                         time ? fmt::format("{} values for {} columns", fields.size(), heading.size())
                              : "the first column is not a time");
    }
    first = to.time_s.empty() ? *time : first;
    for (std::size_t i = 1; i < fields.size(); ++i) {
      append(to.series[i - 1], fields[i], to.time_s.size());
    }
    to.time_s.push_back((*time - first) * unit);
  }
  if (to.time_s.size() < 2) {
    return fmt::format("{}:{}: error: a chart needs at least two rows", name, line);
  }
  if (!std::is_sorted(to.time_s.begin(), to.time_s.end())) {
    return fmt::format("{}: error: the times are not rising", name);
  }
  for (Series& series : to.series) {
    series.steps = series.lines.size() == 1 && (!series.words.empty() || few_whole_values(series.lines.front()));
  }
  return {};
}

}  // namespace indurop::tools
