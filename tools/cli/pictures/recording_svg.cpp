// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/pictures/recording_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/svg_style.h"
#include "tools/cli/pictures/way_svg.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr double kWidth = 1040;
constexpr double kHead = 52;
constexpr double kLeft = 250;
constexpr double kRight = 90;
constexpr double kPlot = kWidth - kLeft - kRight;
constexpr double kLane = 26;
constexpr double kPanel = 150;
constexpr double kGap = 10;
constexpr std::size_t kColors = 8;

// Maps a value to its position on the picture.
struct Scale {
  double from, to, begin, length;
  [[nodiscard]] double at(double value) const { return begin + (value - from) / (to - from) * length; }
};

std::string plain(double value) {
  return fmt::format("{:g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

// For each column of the picture draws the first, the minimum, the maximum and the last of its samples.
std::string path(const std::vector<double>& time, const std::vector<double>& line, const Scale& x, const Scale& y) {
  std::string out;
  bool pen = false;
  for (std::size_t i = 0; i < line.size();) {
    if (std::isnan(line[i])) {
      pen = false;
      ++i;
      continue;
    }
    const double column = std::floor(x.at(time[i]));
    std::size_t end = i;
    std::array<std::size_t, 4> kept{i, i, i, i};  // first, minimum, maximum, last
    while (end < line.size() && std::floor(x.at(time[end])) == column && !std::isnan(line[end])) {
      kept[1] = line[end] < line[kept[1]] ? end : kept[1];
      kept[2] = line[end] > line[kept[2]] ? end : kept[2];
      kept[3] = end++;
    }
    std::sort(kept.begin(), kept.end());
    const auto* const stop = std::unique(kept.begin(), kept.end());
    for (const auto* k = kept.begin(); k != stop; ++k) {
      out +=
          fmt::format("{}{} {}", pen ? "L" : "M", base::svg_number(x.at(time[*k])), base::svg_number(y.at(line[*k])));
      pen = true;
    }
    i = end;
  }
  return out;
}

// Draws stretches of one value: a bar for what is on, with its value or word inside if there is room.
void lane(const Recording& recording, const Series& series, const Scale& x, double top, base::SvgPart& out) {
  const std::vector<double>& line = series.lines.front();
  const double base = top + kLane - 6;
  svg_line(out, kLeft, base, kLeft + kPlot, base, "grid");
  for (std::size_t i = 0; i < line.size();) {
    std::size_t end = i + 1;
    while (end < line.size() && (line[end] == line[i] || (std::isnan(line[end]) && std::isnan(line[i])))) {
      ++end;
    }
    const bool on = !std::isnan(line[i]) && (line[i] != 0 || !series.words.empty());
    if (on) {
      const double left = x.at(recording.time_s[i]);
      const double width = std::max(1.0, x.at(recording.time_s[std::min(end, line.size() - 1)]) - left);
      const std::string value = series.words.empty() ? plain(line[i]) : series.words[static_cast<std::size_t>(line[i])];
      const auto color = static_cast<std::size_t>(std::abs(line[i])) % kColors;
      out.rect(left, top + 2, width, kLane - 8,
               base::svg_class(fmt::format("s{}", series.words.empty() && line[i] == 1 ? 0 : color)),
               fmt::format("{} from {:.3f} s", printable(value), recording.time_s[i]));
      constexpr double kLetter = 6.6;
      const bool says = !series.words.empty() || line[i] != 1;
      if (says && width > kLetter * static_cast<double>(value.size()) + 4) {
        svg_text(out, left + width / 2, base - 5, "middle", "inside", value);
      }
    }
    i = end;
  }
}

void panel(const Recording& recording, const Series& series, const Scale& x, double top, base::SvgPart& out) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& line : series.lines) {
    for (const double value : line) {
      low = std::isfinite(value) ? std::min(low, value) : low;
      high = std::isfinite(value) ? std::max(high, value) : high;
    }
  }
  if (low > high) {
    svg_text(out, kLeft + kPlot / 2, top + kPanel / 2, "middle", "label", "no values");
    return;
  }
  const double room = std::max((high - low) * 0.06, std::max(std::abs(high), 1.0) * 1e-6);
  const double height = kPanel - 2 * kGap;
  const Scale y{low - room, high + room, top + kGap + height, -height};
  for (const double value : round_values(y.from, y.to, 4)) {
    svg_line(out, kLeft, y.at(value), kLeft + kPlot, y.at(value), "grid");
    svg_text(out, kLeft - 6, y.at(value) + 4, "end", "label", plain(value));
  }
  for (std::size_t i = 0; i < series.lines.size(); ++i) {
    out.path(path(recording.time_s, series.lines[i], x, y), base::svg_class(fmt::format("l{}", i % kColors)));
    const auto last =
        std::find_if(series.lines[i].rbegin(), series.lines[i].rend(), [](double v) { return !std::isnan(v); });
    if (series.lines.size() > 1 && last != series.lines[i].rend()) {
      const double line_at = top + kGap + 12 + 15 * static_cast<double>(i);
      out.rect(kLeft + kPlot + 8, line_at - 5, 12, 3, base::svg_class(fmt::format("s{}", i % kColors)));
      svg_text(out, kLeft + kPlot + 24, line_at, "start", "label", part_name(series, i));
    }
  }
}

std::string style() {
  constexpr std::array<const char*, kColors> kPalette{"#2f6fb0", "#c2492f", "#3f8f4f", "#8a5fb0",
                                                      "#c08a1e", "#2f9aa0", "#7a5a44", "#5b6770"};
  std::string out = base::kSvgStyle;
  out +=
      ".name{font-size:13px}.inside{font-size:11px;fill:#ffffff}"
      ".mark{stroke:#c2492f;stroke-width:1.4;stroke-dasharray:5 3}"
      "path{fill:none;stroke-width:1.4;stroke-linejoin:round}";
  for (std::size_t i = 0; i < kColors; ++i) {
    out += fmt::format(".s{0}{{fill:{1}}}.l{0}{{stroke:{1}}}", i, kPalette[i]);
  }
  return out;
}

// Names of panels are shorter, because numbers are on their left as well.
std::string name_of(const Series& series) {
  const std::size_t most = series.steps ? 30 : 24;
  return series.name.size() <= most ? series.name : "..." + series.name.substr(series.name.size() - most + 3);
}

}  // namespace

std::vector<double> round_values(double from, double to, int about) {
  const double rough = (to - from) / about;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = decade * 10;
  for (const double factor : {5.0, 2.0, 1.0}) {
    step = decade * factor >= rough ? decade * factor : step;
  }
  std::vector<double> out;
  const double first = std::ceil(from / step);
  const double last = std::floor(to / step);
  for (int i = 0; first + i <= last; ++i) {
    out.push_back((first + i) * step);
  }
  return out;
}

std::string chart_svg(const std::string& heading, const Recording& recording, const Series* way) {
  const double begin = recording.time_s.front();
  const double end = std::max(recording.time_s.back(), begin + 1e-9);
  const Scale x{begin, end, kLeft, kPlot};
  base::SvgPart body;
  double y = kHead;
  for (const Series& series : recording.series) {
    if (series.lines.empty()) {
      continue;  // never had a value
    }
    svg_text(body, 14, y + (series.steps ? kLane / 2 + 3 : kPanel / 2), "start", "name", name_of(series));
    (series.steps ? lane : panel)(recording, series, x, y, body);
    y += series.steps ? kLane : kPanel;
  }
  base::SvgPart out;
  svg_text(out, 14, 32, "start", "head", heading);
  for (const double second : round_values(begin, end, 10)) {
    svg_line(out, x.at(second), kHead, x.at(second), y + 4, "grid");
    svg_text(out, x.at(second), y + 18, "middle", "label", plain(second) + " s");
  }
  svg_line(out, kLeft, y, kLeft + kPlot, y, "axis");
  out.add(body);
  if (recording.marked) {
    svg_line(out, x.at(0), kHead - 8, x.at(0), y + 4, "mark");
  }
  constexpr double kFoot = 34;
  y += kFoot;
  if (way != nullptr) {
    out.part(0, static_cast<int>(y), way_svg(*way, kWidth - kGap));
    y += kWayHeight;
  }
  return base::svg_document(static_cast<int>(kWidth), static_cast<int>(y), out, style());
}

}  // namespace indurop::tools
