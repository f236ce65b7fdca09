// SPDX-License-Identifier: Apache-2.0
#include "tools/pictures/chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/xml_text.h"
#include "tools/command/units.h"
#include "tools/pictures/svg_parts.h"

namespace indurop::tools {
namespace {

constexpr double kWidth = 1040;
constexpr double kHead = 52;
constexpr double kLeft = 250;
constexpr double kRight = 60;
constexpr double kPlot = kWidth - kLeft - kRight;
constexpr double kLane = 26;
constexpr double kPanel = 150;
constexpr double kGap = 10;
constexpr std::size_t kColors = 8;

// Where a value is on the picture.
struct Scale {
  double from, to, begin, length;
  [[nodiscard]] double at(double value) const { return begin + (value - from) / (to - from) * length; }
};

std::string plain(double value) {
  return fmt::format("{:g}", std::abs(value) < 1e-12 ? 0.0 : value);
}

// Of all samples in one column of the picture the first, the smallest, the largest and the last are drawn.
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
    std::array<std::size_t, 4> kept{i, i, i, i};  // first, smallest, largest, last
    while (end < line.size() && std::floor(x.at(time[end])) == column && !std::isnan(line[end])) {
      kept[1] = line[end] < line[kept[1]] ? end : kept[1];
      kept[2] = line[end] > line[kept[2]] ? end : kept[2];
      kept[3] = end++;
    }
    std::sort(kept.begin(), kept.end());
    const auto* const stop = std::unique(kept.begin(), kept.end());
    for (const auto* k = kept.begin(); k != stop; ++k) {
      out += fmt::format("{}{:.1f} {:.1f}", pen ? "L" : "M", x.at(time[*k]), y.at(line[*k]));
      pen = true;
    }
    i = end;
  }
  return out;
}

// Stretches of one value: a bar for what is on, its value or word inside if there is room.
std::string lane(const Recording& recording, const Series& series, const Scale& x, double top) {
  const std::vector<double>& line = series.lines.front();
  const double base = top + kLane - 6;
  std::string out = svg_line(kLeft, base, kLeft + kPlot, base, "grid");
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
      out += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" class=\"s{}\"><title>{} from {:.3f} "
          "s</title></rect>\n",
          left, top + 2, width, kLane - 8, series.words.empty() ? (line[i] == 1 ? 0 : color) : color,
          base::xml_text(printable(value)), recording.time_s[i]);
      constexpr double kLetter = 6.6;
      const bool says = !series.words.empty() || line[i] != 1;
      if (says && width > kLetter * static_cast<double>(value.size()) + 4) {
        out += svg_text(left + width / 2, base - 5, "middle", "inside", value);
      }
    }
    i = end;
  }
  return out;
}

std::string panel(const Recording& recording, const Series& series, const Scale& x, double top) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& line : series.lines) {
    for (const double value : line) {
      low = std::isfinite(value) ? std::min(low, value) : low;
      high = std::isfinite(value) ? std::max(high, value) : high;
    }
  }
  if (low > high) {
    return svg_text(kLeft + kPlot / 2, top + kPanel / 2, "middle", "label", "no values");
  }
  const double room = std::max((high - low) * 0.06, std::max(std::abs(high), 1.0) * 1e-6);
  const double height = kPanel - 2 * kGap;
  const Scale y{low - room, high + room, top + kGap + height, -height};
  std::string out;
  for (const double value : round_values(y.from, y.to, 4)) {
    out += svg_line(kLeft, y.at(value), kLeft + kPlot, y.at(value), "grid");
    out += svg_text(kLeft - 6, y.at(value) + 4, "end", "label", plain(value));
  }
  for (std::size_t i = 0; i < series.lines.size(); ++i) {
    out += fmt::format("<path d=\"{}\" class=\"l{}\"/>\n", path(recording.time_s, series.lines[i], x, y), i % kColors);
    const auto last =
        std::find_if(series.lines[i].rbegin(), series.lines[i].rend(), [](double v) { return !std::isnan(v); });
    if (series.lines.size() > 1 && last != series.lines[i].rend()) {
      const double line_at = top + kGap + 12 + 15 * static_cast<double>(i);
      out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"12\" height=\"3\" class=\"s{}\"/>\n",
                         kLeft + kPlot + 8, line_at - 5, i % kColors);
      out += svg_text(kLeft + kPlot + 24, line_at, "start", "label", fmt::format("[{}]", i));
    }
  }
  return out;
}

std::string style() {
  constexpr std::array<const char*, kColors> kPalette{"#2f6fb0", "#c2492f", "#3f8f4f", "#8a5fb0",
                                                      "#c08a1e", "#2f9aa0", "#7a5a44", "#5b6770"};
  std::string out =
      "<style>text{font-family:Helvetica,Arial,sans-serif;fill:#22303c}.head{font-size:19px;font-weight:bold}"
      ".name{font-size:13px}.label{font-size:11px;fill:#55636f}.inside{font-size:11px;fill:#ffffff}"
      ".grid{stroke:#e4e9ed}.axis{stroke:#22303c;stroke-width:1.2}path{fill:none;stroke-width:1.4;stroke-linejoin:"
      "round}";
  for (std::size_t i = 0; i < kColors; ++i) {
    out += fmt::format(".s{0}{{fill:{1}}}.l{0}{{stroke:{1}}}", i, kPalette[i]);
  }
  return out + "</style>\n";
}

std::string name_of(const Series& series) {
  constexpr std::size_t kMost = 30;
  return series.name.size() <= kMost ? series.name : "..." + series.name.substr(series.name.size() - kMost + 3);
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

std::string chart_svg(const std::string& heading, const Recording& recording) {
  const double end = std::max(recording.time_s.back(), 1e-9);
  const Scale x{0, end, kLeft, kPlot};
  std::string body;
  double y = kHead;
  for (const Series& series : recording.series) {
    if (series.lines.empty()) {
      continue;  // never had a value
    }
    body += svg_text(14, y + (series.steps ? kLane / 2 + 3 : kPanel / 2), "start", "name", name_of(series));
    body += series.steps ? lane(recording, series, x, y) : panel(recording, series, x, y);
    y += series.steps ? kLane : kPanel;
  }
  std::string grid;
  for (const double second : round_values(0, end, 10)) {
    grid += svg_line(x.at(second), kHead, x.at(second), y + 4, "grid");
    grid += svg_text(x.at(second), y + 18, "middle", "label", plain(second) + " s");
  }
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
             "{1:.0f}\">\n{2}<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
             kWidth, y + 34, style()) +
         svg_text(14, 32, "start", "head", heading) + grid + svg_line(kLeft, y, kLeft + kPlot, y, "axis") + body +
         "</svg>\n";
}

}  // namespace indurop::tools
