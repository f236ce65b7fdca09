// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/pictures/way_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "core/base/svg_style.h"
#include "tools/cli/pictures/recording_svg.h"

namespace indurop::tools {
namespace {

constexpr double kWayLeft = 64;    // for the numbers of the upward axis
constexpr double kWayTop = 34;     // for the name
constexpr double kWayBottom = 34;  // for the numbers of the other axis
constexpr double kApart = 30;      // between the projections
constexpr double kEndRadius = 4;

struct DrawnArea {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(std::span<const double> values) {
    for (const double value : values) {
      low = std::isfinite(value) ? std::min(low, value) : low;
      high = std::isfinite(value) ? std::max(high, value) : high;
    }
  }
  [[nodiscard]] bool empty() const { return low > high; }
  [[nodiscard]] double size() const { return high - low; }
  [[nodiscard]] double middle() const { return (low + high) / 2; }
};

struct Projection {
  double left, width;
  const char* across_name;
  const char* up_name;
  const std::vector<double>& across;
  const std::vector<double>& up;
};

// Maps values to positions on the picture: the middle of the path is in the middle of the picture, one scale for both
// directions.
struct Frame {
  double left, top, width, height, per_unit;
  DrawnArea across, up;

  [[nodiscard]] double x(double value) const { return left + width / 2 + (value - across.middle()) * per_unit; }
  [[nodiscard]] double y(double value) const { return top + height / 2 - (value - up.middle()) * per_unit; }
  [[nodiscard]] double x_value(double at) const { return (at - left - width / 2) / per_unit + across.middle(); }
  [[nodiscard]] double y_value(double at) const { return (top + height / 2 - at) / per_unit + up.middle(); }
};

void grid(const Frame& frame, base::SvgPart& out) {
  const auto label = [](double value) { return fmt::format("{:g}", std::fabs(value) < 1e-9 ? 0.0 : value); };
  for (const double value : round_values(frame.x_value(frame.left), frame.x_value(frame.left + frame.width), 5)) {
    svg_line(out, frame.x(value), frame.top, frame.x(value), frame.top + frame.height, "grid");
    svg_text(out, frame.x(value), frame.top + frame.height + 16, "middle", "label", label(value));
  }
  for (const double value : round_values(frame.y_value(frame.top + frame.height), frame.y_value(frame.top), 5)) {
    svg_line(out, frame.left, frame.y(value), frame.left + frame.width, frame.y(value), "grid");
    svg_text(out, frame.left - 6, frame.y(value) + 4, "end", "label", label(value));
  }
}

void draw(const Projection& projection, const Frame& frame, const std::string& name, base::SvgPart& out) {
  svg_text(out, frame.left, kWayTop - 12, "start", "name",
           fmt::format("{}: {} across, {} up", name, projection.across_name, projection.up_name));
  grid(frame, out);
  std::string way;
  std::array<double, 4> ends{};  // first and last point
  for (std::size_t i = 0; i < std::min(projection.across.size(), projection.up.size()); ++i) {
    if (!std::isfinite(projection.across[i]) || !std::isfinite(projection.up[i])) {
      continue;
    }
    const double x = frame.x(projection.across[i]);
    const double y = frame.y(projection.up[i]);
    if (way.empty()) {
      ends = {x, y, x, y};
    } else if (base::svg_number(x) == base::svg_number(ends[2]) && base::svg_number(y) == base::svg_number(ends[3])) {
      continue;  // it does not move
    }
    way += fmt::format("{}{} {}", way.empty() ? "M" : "L", base::svg_number(x), base::svg_number(y));
    ends[2] = x;
    ends[3] = y;
  }
  out.path(way, base::svg_class("l0"));
  out.circle(ends[0], ends[1], kEndRadius, "class=\"l1\" fill=\"none\"");
  out.circle(ends[2], ends[3], kEndRadius, base::svg_class("s1"));
}

}  // namespace

base::SvgPart way_svg(const Series& series, double width) {
  base::SvgPart out;
  if (series.lines.size() < 2) {
    return out;
  }
  const bool flat = series.lines.size() == 2;
  const double each = (width - (flat ? 1 : 2) * kWayLeft - (flat ? 0 : kApart)) / (flat ? 1 : 2);
  std::vector<Projection> projections{{kWayLeft, each, "x", "y", series.lines[0], series.lines[1]}};
  if (!flat) {
    projections.push_back({2 * kWayLeft + each + kApart, each, "x", "z", series.lines[0], series.lines[2]});
  }
  const double height = kWayHeight - kWayTop - kWayBottom;
  std::vector<Frame> frames;
  double per_unit = std::numeric_limits<double>::infinity();
  for (const Projection& projection : projections) {
    Frame frame{projection.left, kWayTop, projection.width, height, 1, {}, {}};
    frame.across.take(projection.across);
    frame.up.take(projection.up);
    if (frame.across.empty() || frame.up.empty()) {
      return out;
    }
    constexpr double kRoom = 1.1;
    constexpr double kLeast = 1e-6;
    per_unit = std::min({per_unit, projection.width / (kRoom * std::max(frame.across.size(), kLeast)),
                         height / (kRoom * std::max(frame.up.size(), kLeast))});
    frames.push_back(frame);
  }
  for (std::size_t i = 0; i < projections.size(); ++i) {
    frames[i].per_unit = per_unit;
    draw(projections[i], frames[i], series.name, out);
  }
  return out;
}

}  // namespace indurop::tools
