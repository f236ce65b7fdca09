// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/pictures/histogram_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/base/svg_style.h"
#include "tools/cli/pictures/histogram_bins.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr double kHistogramWidth = 960;
constexpr double kHistogramHead = 56;
constexpr double kHistogramPanel = 250;
constexpr double kHistogramLeft = 70;
constexpr double kHistogramRight = 24;
constexpr double kTop = 66;     // above the plot, inside its panel
constexpr double kBottom = 40;  // below the plot
constexpr double kPlotWidth = kHistogramWidth - kHistogramLeft - kHistogramRight;
constexpr double kPlotHeight = kHistogramPanel - kTop - kBottom;
constexpr std::size_t kMostBars = 90;

// Maps a positive range logarithmically to positions on the picture.
class LogScale {
 public:
  LogScale(double from, double to, double begin, double length)
      : from_(std::log10(from)),
        span_(std::max(1e-9, std::log10(to) - std::log10(from))),
        begin_(begin),
        length_(length) {}
  [[nodiscard]] double at(double value) const {
    const double part = (std::log10(std::max(value, 1e-12)) - from_) / span_;
    return begin_ + std::clamp(part, 0.0, 1.0) * length_;
  }
  [[nodiscard]] double decades() const { return span_; }

 private:
  double from_;
  double span_;
  double begin_;
  double length_;
};

double positive(std::uint64_t ns) {
  return std::max(0.5, static_cast<double>(ns));
}

// Returns 1, 2, 5, 10 ... between the ends; only powers of ten if there would be many.
std::vector<double> tick_values(double from, double to, bool dense) {
  std::vector<double> out;
  for (int power = static_cast<int>(std::floor(std::log10(from))); std::pow(10.0, power) <= to; ++power) {
    const double decade = std::pow(10.0, power);
    for (const double step : {1.0, 2.0, 5.0}) {
      const double value = decade * step;
      if (value >= from * 0.999 && value <= to * 1.001 && (dense || step == 1.0)) {
        out.push_back(value);
      }
    }
  }
  return out;
}

std::string count_text(double count) {
  return count >= 1e6   ? fmt::format("{:g}M", count / 1e6)
         : count >= 1e3 ? fmt::format("{:g}k", count / 1e3)
                        : fmt::format("{:g}", count);
}

struct Marker {
  const char* name;
  std::int64_t value;
};

void markers(const scheduler::Summary& summary, const LogScale& x, double top, base::SvgPart& out) {
  const std::array<Marker, 4> all{
      {{"p50", summary.p50}, {"p99", summary.p99}, {"p99.9", summary.p99_9}, {"max", summary.max}}};
  constexpr double kLabelWidth = 92;
  // Labels that would touch are placed one line higher.
  std::array<double, 3> busy_until{};
  busy_until.fill(-1e9);
  for (const Marker& marker : all) {
    const double at = x.at(std::max(0.5, static_cast<double>(marker.value)));
    const double center =
        std::clamp(at, kHistogramLeft + kLabelWidth / 2, kHistogramWidth - kHistogramRight - kLabelWidth / 2);
    std::size_t row = 0;
    while (row + 1 < busy_until.size() && center - kLabelWidth / 2 < busy_until[row]) {
      ++row;
    }
    busy_until[row] = center + kLabelWidth / 2;
    const double y = top - 6 - 13 * static_cast<double>(row);
    svg_line(out, at, y + 3, at, top + kPlotHeight, "mark");
    svg_text(out, center, y, "middle", "label", fmt::format("{} {}", marker.name, human_ns(marker.value)));
  }
}

std::string name_of_decade(double ns) {
  if (ns >= 1e9) {
    return fmt::format("{:g} s", ns / 1e9);
  }
  if (ns >= 1e6) {
    return fmt::format("{:g} ms", ns / 1e6);
  }
  return ns >= 1e3 ? fmt::format("{:g} us", ns / 1e3) : fmt::format("{:g} ns", ns);
}

void panel_svg(const HistogramPanel& panel, double y0, base::SvgPart& out) {
  svg_text(out, kHistogramLeft, y0 + 18, "start", "title", panel.title);
  svg_text(out, kHistogramWidth - kHistogramRight, y0 + 18, "end", "label",
           fmt::format("{}, {} runs, mean {}", panel.subtitle, panel.summary.count, human_ns(panel.summary.mean)));
  const double top = y0 + kTop;
  const double base = top + kPlotHeight;
  const auto bins = gather(panel.counts, kMostBars);
  if (bins.empty()) {
    svg_text(out, kHistogramWidth / 2, top + kPlotHeight / 2, "middle", "label", "nothing measured");
    return;
  }
  const double from = positive(bins.front().from_ns);
  const double to = std::max(from * 1.5, positive(bins.back().to_ns));
  const LogScale x(from, to, kHistogramLeft, kPlotWidth);
  double highest = 1;
  for (const Bin& bin : bins) {
    highest = std::max(highest, static_cast<double>(bin.count));
  }
  const LogScale height(0.7, highest * 1.3, 0, kPlotHeight);
  for (const double count : tick_values(1, highest, height.decades() < 2)) {
    svg_line(out, kHistogramLeft, base - height.at(count), kHistogramWidth - kHistogramRight, base - height.at(count),
             "grid");
    svg_text(out, kHistogramLeft - 8, base - height.at(count) + 4, "end", "label", count_text(count));
  }
  for (const double ns : tick_values(from, to, x.decades() < 2.5)) {
    svg_line(out, x.at(ns), top, x.at(ns), base + 4, "grid");
    svg_text(out, x.at(ns), base + 18, "middle", "label", name_of_decade(ns));
  }
  for (const Bin& bin : bins) {
    if (bin.count > 0) {
      const double left = x.at(positive(bin.from_ns));
      const double width = std::max(1.0, x.at(positive(bin.to_ns)) - left - 0.6);
      const double h = height.at(static_cast<double>(bin.count));
      out.rect(left, base - h, width, h, base::svg_class("bar"),
               fmt::format("{} to {}: {}", human_ns(static_cast<std::int64_t>(bin.from_ns)),
                           human_ns(static_cast<std::int64_t>(bin.to_ns)), bin.count));
    }
  }
  svg_line(out, kHistogramLeft, base, kHistogramWidth - kHistogramRight, base, "axis");
  markers(panel.summary, x, top, out);
}

}  // namespace

std::string histogram_svg(const std::string& heading, std::span<const HistogramPanel> panels) {
  const double height =
      kHistogramHead + kHistogramPanel * static_cast<double>(std::max<std::size_t>(1, panels.size())) + 12;
  base::SvgPart out;
  svg_text(out, kHistogramLeft, 34, "start", "head", heading);
  if (panels.empty()) {
    svg_text(out, kHistogramLeft, kHistogramHead + 30, "start", "label", "nothing measured");
  }
  double y = kHistogramHead;
  for (const auto& panel : panels) {
    panel_svg(panel, y, out);
    y += kHistogramPanel;
  }
  std::string style = base::kSvgStyle;
  style +=
      ".title{font-size:15px;font-weight:bold}.bar{fill:#3b7dbf}"
      ".mark{stroke:#c2492f;stroke-dasharray:3 3}";
  return base::svg_document(static_cast<int>(kHistogramWidth), static_cast<int>(height), out, style);
}

}  // namespace indurop::tools
