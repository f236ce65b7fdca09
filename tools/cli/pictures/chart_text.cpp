// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/pictures/chart_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tools/client/text/table.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::size_t kLeast = 16;  // width of the blocks
constexpr std::size_t kMostName = 34;
constexpr std::size_t kNumbers = 24;  // right of the blocks

struct Row {
  std::string name;
  const std::vector<double>* line;
  const Series* series;
};

// Returns the last value of each interval of time; NaN where there is none.
std::vector<double> squeeze(const std::vector<double>& time, const std::vector<double>& line, std::size_t width) {
  std::vector<double> out(width, std::nan(""));
  for (std::size_t i = 0; i < line.size(); ++i) {
    const double part = (time[i] - time.front()) / std::max(time.back() - time.front(), 1e-9);
    out[std::min(width - 1, static_cast<std::size_t>(part * static_cast<double>(width)))] = line[i];
  }
  for (std::size_t i = 1; i < width; ++i) {
    out[i] = std::isnan(out[i]) ? out[i - 1] : out[i];
  }
  return out;
}

std::string block(double part, bool unicode) {
  constexpr std::array<const char*, 8> kBlocks{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  const auto level = [part](std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(part * static_cast<double>(count)));
  };
  return unicode ? kBlocks[level(kBlocks.size())] : std::string(1, static_cast<char>('0' + level(10)));
}

std::string value_text(const Series& series, double value) {
  return series.words.empty() ? fmt::format("{:.6g}", value) : printable(series.words[static_cast<std::size_t>(value)]);
}

std::string draw(const Row& row, const std::vector<double>& time, std::size_t width, bool unicode) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : *row.line) {
    low = std::isfinite(value) ? std::min(low, value) : low;
    high = std::isfinite(value) ? std::max(high, value) : high;
  }
  std::string out;
  for (const double value : squeeze(time, *row.line, width)) {
    out += std::isfinite(value) ? block(high > low ? (value - low) / (high - low) : 0, unicode) : " ";
  }
  if (low > high) {
    return out;
  }
  return out + "  " +
         (low == high ? value_text(*row.series, low)
                      : value_text(*row.series, low) + " .. " + value_text(*row.series, high));
}

// Returns the time axis: begin and end; '^' marks the trigger.
std::string axis(const Recording& recording, std::size_t width) {
  const double begin = recording.time_s.front();
  const double end = recording.time_s.back();
  std::string line = begin == 0 ? "0" : fmt::format("{:.3g} s", begin);
  line.resize(width, ' ');
  const std::string right = fmt::format("{:.3g} s", end);
  line.replace(width - right.size(), right.size(), right);
  if (recording.marked) {
    const double part = -begin / std::max(end - begin, 1e-9);
    line[std::min(width - 1, static_cast<std::size_t>(part * static_cast<double>(width)))] = '^';
  }
  return line;
}

}  // namespace

std::vector<std::string> chart_lines(const Recording& recording, int columns, bool unicode) {
  std::vector<Row> rows;
  std::size_t name_width = 4;
  for (const Series& series : recording.series) {
    for (std::size_t i = 0; i < series.lines.size(); ++i) {
      std::string name =
          printable(series.lines.size() > 1 ? series.name + (series.parts.empty() ? "" : " ") + part_name(series, i)
                                            : series.name);
      name = name.size() <= kMostName ? name : "..." + name.substr(name.size() - kMostName + 3);
      name_width = std::max(name_width, name.size());
      rows.push_back({name, &series.lines[i], &series});
    }
  }
  const std::size_t taken = name_width + 2 + kNumbers;
  const auto all = static_cast<std::size_t>(std::max(columns, 1));
  const std::size_t width = std::max(kLeast, all > taken ? all - taken : 0);
  std::vector<std::string> out;
  out.reserve(rows.size() + 1);
  for (const Row& row : rows) {
    out.push_back(fmt::format("{:<{}}  {}", row.name, name_width, draw(row, recording.time_s, width, unicode)));
  }
  out.push_back(fmt::format("{:<{}}  {}", "", name_width, axis(recording, width)));
  return out;
}

}  // namespace indurop::tools
