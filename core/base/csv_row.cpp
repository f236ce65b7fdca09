// SPDX-License-Identifier: Apache-2.0
#include "core/base/csv_row.h"

#include <algorithm>
#include <array>
#include <utility>

namespace indurop::base {

std::vector<CsvCell> take_csv_row(std::string_view& text, char separator, std::size_t& line) {
  std::vector<CsvCell> cells{{"", line, 1}};
  bool quoted = false;
  std::size_t at = 0;
  std::size_t line_start = 0;
  for (bool ended = false; at < text.size() && !ended; ++at) {
    const char c = text[at];
    if (c == '\n') {
      ++line;
      line_start = at + 1;
    }
    if (quoted && c == '"' && at + 1 < text.size() && text[at + 1] == '"') {
      cells.back().text += text[++at];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      cells.push_back({"", line, at + 2 - line_start});
    } else if (c == '\n' && !quoted) {
      ended = true;
    } else if (c != '\r') {
      cells.back().text += c;
    }
  }
  if (at == text.size() && (at == 0 || text[at - 1] != '\n')) {
    ++line;  // the last line need not end
  }
  text.remove_prefix(at);
  return cells;
}

std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    return std::string(text);
  }
  std::string field = "\"";
  for (const char c : text) {
    field += c;
    if (c == '"') {
      field += c;
    }
  }
  return field + '"';
}

double csv_time_unit(std::string_view name) noexcept {
  constexpr std::array<std::pair<std::string_view, double>, 5> kUnits{
      {{"time", 1}, {"time_s", 1}, {"time_ms", 1e-3}, {"time_us", 1e-6}, {"time_ns", 1e-9}}};
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [name](const auto& unit) { return unit.first == name; });
  return found == kUnits.end() ? 0 : found->second;
}

}  // namespace indurop::base
