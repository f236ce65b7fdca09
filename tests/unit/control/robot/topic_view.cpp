// SPDX-License-Identifier: Apache-2.0
#include "topic_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/base/svg_style.h"

namespace indurop::robot {
namespace {

constexpr double kLabel = 11;  // px
// Places that are exactly between two numbers are rounded equally on every machine.
constexpr double kUntie = 0.0013;  // px
// Of two places that differ by less than rounding errors, the first one is taken.
constexpr double kSame = 1e-6;  // px

double distance_of(const Pixel& a, const Pixel& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// The tip of another tool is elsewhere, without a motion.
bool jumps(const TopicSample& a, const TopicSample& b) {
  const double way = std::hypot(a.tip[0] - b.tip[0], a.tip[1] - b.tip[1], a.tip[2] - b.tip[2]);
  return way > 2 + 2 * TopicRun::kPeriod * std::max(a.speed, b.speed);
}

// Douglas and Peucker: leaves out what is within a quarter of a pixel of the rest.
void thin(const std::vector<Pixel>& way, std::size_t first, std::size_t last, std::vector<Pixel>& out) {
  double most = 0.25;
  std::size_t farthest = first;
  const double length = distance_of(way[first], way[last]);
  for (std::size_t i = first + 1; i < last; ++i) {
    const double area = (way[last].x - way[first].x) * (way[i].y - way[first].y) -
                        (way[last].y - way[first].y) * (way[i].x - way[first].x);
    const double off = length < 0.1 ? distance_of(way[i], way[first]) : std::abs(area) / length;
    if (off > most + kSame) {
      most = off;
      farthest = i;
    }
  }
  if (farthest != first) {
    thin(way, first, farthest, out);
    thin(way, farthest, last, out);
    return;
  }
  out.push_back(way[last]);
}

double overlap(const Frame& a, const Frame& b) {
  const double width = std::min(a.left + a.width, b.left + b.width) - std::max(a.left, b.left);
  const double height = std::min(a.top + a.height, b.top + b.height) - std::max(a.top, b.top);
  return std::max(0.0, width) * std::max(0.0, height);
}

}  // namespace

std::string path_of(const std::vector<Pixel>& way) {
  std::vector<Pixel> out{way.front()};
  thin(way, 0, way.size() - 1, out);
  std::string text;
  for (const Pixel& place : out) {
    text += fmt::format("{}{} {}", text.empty() ? "M" : "L", base::svg_number(place.x), base::svg_number(place.y));
  }
  return text;
}

LabelRoom::LabelRoom(const Frame& frame)
    : frame_(frame),
      columns_(static_cast<std::size_t>(frame.width / kCell) + 1),
      rows_(static_cast<std::size_t>(frame.height / kCell) + 1),
      path_(columns_ * rows_) {}

void LabelRoom::occupy(const Pixel& path) {
  const double column = (path.x - frame_.left) / kCell;
  const double row = (path.y - frame_.top) / kCell;
  if (column >= 0 && row >= 0 && column < static_cast<double>(columns_) && row < static_cast<double>(rows_)) {
    path_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)] = 1;
  }
}

void LabelRoom::occupy(const Frame& box) {
  boxes_.push_back(box);
}

double LabelRoom::cost(const Frame& box) const {
  double sum = 1000 * (box.width * box.height - overlap(box, frame_));
  for (const Frame& other : boxes_) {
    sum += 20 * overlap(box, other);
  }
  for (double y = box.top; y < box.top + box.height; y += kCell) {
    for (double x = box.left; x < box.left + box.width; x += kCell) {
      const double column = std::floor((x - frame_.left) / kCell);
      const double row = std::floor((y - frame_.top) / kCell);
      if (column >= 0 && row >= 0 && column < static_cast<double>(columns_) && row < static_cast<double>(rows_)) {
        sum += 12 * path_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
      }
    }
  }
  return sum;
}

Frame LabelRoom::find(const Pixel& place, double width, double height) {
  constexpr std::array<std::array<double, 2>, 8> kDirections{
      {{1, -1}, {1, 1}, {-1, -1}, {-1, 1}, {1, 0}, {-1, 0}, {0, -1}, {0, 1}}};
  Frame best{};
  double least = 1e300;
  for (const double far : {6.0, 12.0, 20.0, 30.0, 44.0, 60.0}) {
    for (const auto& [right, down] : kDirections) {
      const double slant = right != 0 && down != 0 ? 0.75 : 1;
      const Frame box{place.x + right * (far * slant + width / 2) - width / 2,
                      place.y + down * (far * slant + height / 2) - height / 2, width, height};
      const double price = cost(box) + 3 * far;
      if (price < least - kSame) {
        least = price;
        best = box;
      }
    }
  }
  occupy(best);
  return best;
}

std::string speed_colour(double part) {
  constexpr std::array<std::array<double, 3>, 5> kStops{
      {{49, 54, 149}, {106, 61, 180}, {190, 50, 140}, {230, 85, 70}, {245, 150, 20}}};
  const double at = std::clamp(part, 0.0, 1.0) * (kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  std::string text = "#";
  for (std::size_t i = 0; i < 3; ++i) {
    const double mixed =
        kStops[below][i] + (at - static_cast<double>(below)) * (kStops[below + 1][i] - kStops[below][i]);
    text += fmt::format("{:02x}", static_cast<int>(mixed + 0.5 + kUntie));
  }
  return text;
}

TopicView::TopicView(Kind kind, const Frame& frame, const Axes& axes)
    : kind_(kind), frame_(frame), axes_(axes), room_(frame) {}

Pixel TopicView::place(const std::array<double, 3>& tip, double time) const {
  const double across = axes_.across == 't' ? time : axes_.across == 'x' ? tip[0] : tip[1];
  const double up = kind_ != Kind::FromAbove ? tip[2] : axes_.across == 'x' ? tip[1] : tip[0];
  const double y = (up - axes_.first_up) * axes_.scale_up;
  return {frame_.left + (across - axes_.first) * axes_.scale + kUntie,
          (up_is_down() ? frame_.top + y : frame_.top + frame_.height - y) + kUntie};
}

Pixel TopicView::place(const TopicSample& sample) const {
  return place(sample.tip, sample.time);
}

bool TopicView::shows(const Pixel& place) const {
  return place.x >= frame_.left && place.x <= frame_.left + frame_.width && place.y >= frame_.top &&
         place.y <= frame_.top + frame_.height;
}

std::string TopicView::caption() const {
  if (kind_ == Kind::OverTime) {
    return "height over time";
  }
  if (kind_ == Kind::FromAbove) {
    return axes_.across == 'x' ? "from above" : "from above, the robot is at the top";
  }
  return axes_.across == 'x' ? "from the side" : "from the front";
}

void TopicView::draw_axes(base::SvgPart& out) {
  const double right = frame_.left + frame_.width;
  const double bottom = frame_.top + frame_.height;
  const double step = nice_step(48 / axes_.scale);
  for (double value = std::ceil(axes_.first / step) * step; (value - axes_.first) * axes_.scale < frame_.width;
       value += step) {
    const double x = frame_.left + (value - axes_.first) * axes_.scale;
    base::svg_line(out, x, frame_.top, x, bottom, "grid");
    if (x < right - (axes_.across == 't' ? 56 : 44)) {
      base::svg_text(out, x, bottom + 14, "middle", "label", fmt::format("{:g}", value + 0.0));
    }
  }
  const double step_up = nice_step(26 / axes_.scale_up);
  for (double value = std::ceil(axes_.first_up / step_up) * step_up;
       (value - axes_.first_up) * axes_.scale_up < frame_.height; value += step_up) {
    const double way = (value - axes_.first_up) * axes_.scale_up;
    const double y = up_is_down() ? frame_.top + way : bottom - way;
    base::svg_line(out, frame_.left, y, right, y, "grid");
    base::svg_text(out, frame_.left - 5, y + 4, "end", "label", fmt::format("{:g}", value + 0.0));
  }
  out.rect(frame_.left, frame_.top, frame_.width, frame_.height, "class=\"frame\"");
  const char* const up = kind_ != Kind::FromAbove ? "z" : axes_.across == 'x' ? "y" : "x";
  base::svg_text(out, right, bottom + 14, "end", "label",
                 axes_.across == 't' ? "time in s" : fmt::format("{} in mm", axes_.across));
  out.text(frame_.left - 42, frame_.top + frame_.height / 2, fmt::format("{} in mm", up),
           fmt::format("text-anchor=\"middle\" class=\"label\" transform=\"rotate(-90 {} {})\"",
                       base::svg_number(frame_.left - 42), base::svg_number(frame_.top + frame_.height / 2)));
  base::svg_text(out, frame_.left + 7, frame_.top + 16, "start", "caption", caption());
  room_.occupy(Frame{frame_.left, frame_.top, text_width(caption(), 12) + 14, 22});
}

void TopicView::draw_band(base::SvgPart& out, const TopicTrace& trace, const std::string& signal,
                          const std::string& colour) {
  std::vector<Pixel> way;
  const auto finish = [&] {
    if (way.size() > 1) {
      out.path(path_of(way), fmt::format("class=\"band\" stroke=\"{}\"", colour));
    }
    way.clear();
  };
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    if (trace.samples[i].values.at(signal) == 0 || (i > 0 && jumps(trace.samples[i - 1], trace.samples[i]))) {
      finish();
    }
    if (trace.samples[i].values.at(signal) != 0) {
      way.push_back(place(trace.samples[i]));
    }
  }
  finish();
}

void TopicView::draw_path(base::SvgPart& out, const TopicTrace& trace, double top_speed) {
  constexpr double kLevels = 14;
  std::set<std::pair<std::string, int>> drawn;  // motions that are repeated are drawn once
  std::vector<Pixel> way;
  int level = -1;
  const auto finish = [&] {
    if (way.size() > 1 && drawn.emplace(path_of(way), level).second) {
      out.path(path_of(way), fmt::format("class=\"way\" stroke=\"{}\"", speed_colour(level / kLevels)));
    }
    way.clear();
  };
  for (std::size_t i = 1; i < trace.samples.size(); ++i) {
    const TopicSample& a = trace.samples[i - 1];
    const TopicSample& b = trace.samples[i];
    const int now = static_cast<int>(std::max(a.speed, b.speed) / top_speed * kLevels + 0.5 + kSame);
    const bool broken = jumps(a, b);
    if (now != level || broken) {
      finish();
      level = now;
    }
    if (broken) {
      continue;
    }
    if (way.empty()) {
      way.push_back(place(a));
    }
    way.push_back(place(b));
    const double steps = std::ceil(distance_of(place(a), place(b)) + 0.5);
    for (double k = 0; k < steps; ++k) {
      room_.occupy(Pixel{place(a).x + (place(b).x - place(a).x) * k / steps,
                         place(a).y + (place(b).y - place(a).y) * k / steps});
    }
  }
  finish();
  if (kind_ != Kind::OverTime) {
    draw_arrows(out, trace, top_speed);
  }
}

// One in the middle of each short motion, more on long ones; where the path is passed again, one is enough.
void TopicView::draw_arrows(base::SvgPart& out, const TopicTrace& trace, double top_speed) {
  std::vector<std::size_t> ends{0};
  for (const std::size_t rest : trace.rests()) {
    ends.push_back(rest);
  }
  ends.push_back(trace.samples.size() - 1);
  std::set<std::tuple<int, int, int>> drawn;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    std::vector<double> length{0};
    for (std::size_t i = ends[k] + 1; i <= ends[k + 1]; ++i) {
      length.push_back(length.back() + distance_of(place(trace.samples[i - 1]), place(trace.samples[i])));
    }
    if (length.back() < 16) {
      continue;
    }
    const double count = std::max(1.0, std::round(length.back() / 110));
    for (double n = 0.5; n < count; ++n) {
      const auto found = std::lower_bound(length.begin(), length.end(), length.back() * n / count - kSame);
      const std::size_t i = ends[k] + static_cast<std::size_t>(found - length.begin());
      const Pixel a = place(trace.samples[i - 1]);
      const Pixel b = place(trace.samples[i]);
      const double way = distance_of(a, b);
      if (way < 0.01 || jumps(trace.samples[i - 1], trace.samples[i])) {
        continue;
      }
      const double u = (b.x - a.x) / way;
      const double v = (b.y - a.y) / way;
      const int octant = static_cast<int>(std::lround(std::atan2(v, u) * 4 / kPi + 8)) % 8;
      if (!drawn.emplace(static_cast<int>(b.x / 18), static_cast<int>(b.y / 18), octant).second) {
        continue;
      }
      using base::svg_number;
      out.path(fmt::format("M{} {}L{} {}L{} {}Z", svg_number(b.x + 5 * u), svg_number(b.y + 5 * v),
                           svg_number(b.x - 4 * u - 4.5 * v), svg_number(b.y - 4 * v + 4.5 * u),
                           svg_number(b.x - 4 * u + 4.5 * v), svg_number(b.y - 4 * v - 4.5 * u)),
               fmt::format("class=\"arrow\" fill=\"{}\"", speed_colour(trace.samples[i].speed / top_speed)));
      room_.occupy(Frame{b.x - 5, b.y - 5, 10, 10});
    }
  }
}

void TopicView::draw_taught(base::SvgPart& out, const TopicTrace& trace, const std::string& from,
                            const std::string& to) {
  const Pixel a = place(trace.points.at(from), 0);
  const Pixel b = place(trace.points.at(to), 0);
  base::svg_line(out, a.x, a.y, b.x, b.y, "taught");
}

void TopicView::draw_points(base::SvgPart& out, const TopicTrace& trace) {
  for (const auto& [name, tip] : trace.points) {
    const Pixel at = place(tip, 0);
    if (kind_ == Kind::OverTime) {
      if (shows({frame_.left, at.y})) {
        base::svg_line(out, frame_.left, at.y, frame_.left + frame_.width, at.y, "level");
        base::svg_text(out, frame_.left + frame_.width + 5, at.y + 4, "start", "point", name);
      }
      continue;
    }
    if (!shows(at)) {
      continue;
    }
    base::svg_line(out, at.x - 6, at.y, at.x + 6, at.y, "cross");
    base::svg_line(out, at.x, at.y - 6, at.x, at.y + 6, "cross");
    room_.occupy(Frame{at.x - 7, at.y - 7, 14, 14});
    const double width = 1.15 * text_width(name, kLabel);  // bold
    const Frame box = room_.find(at, width + 4, 13);
    base::svg_text(out, box.left + 2 + width / 2, box.top + 10, "middle", "point", name);
  }
}

void TopicView::draw_mark(base::SvgPart& out, const TopicSample& sample, bool is_output, bool is_on,
                          const std::string& colour) {
  Pixel at = place(sample);
  const std::string kind = colour + (is_on ? "+" : "-");
  // Next to a mark of another kind.
  while (std::any_of(marks_.begin(), marks_.end(), [&](const auto& mark) {
    return mark.second != kind && std::abs(mark.first.y - at.y) < 9 && std::abs(mark.first.x - at.x) < 10.5;
  })) {
    at.x += 1;
  }
  marks_.emplace_back(at, kind);
  draw_signal_mark(out, at, is_output, is_on, colour);
  room_.occupy(Frame{at.x - 7, at.y - 7, 14, 14});
}

void TopicView::draw_rests(base::SvgPart& out, const TopicTrace& trace) {
  std::vector<Pixel> drawn;
  for (const std::size_t i : trace.rests()) {
    const Pixel at = place(trace.samples[i]);
    const auto is_near = [&](const Pixel& other) { return distance_of(other, at) < 2; };
    if (std::none_of(drawn.begin(), drawn.end(), is_near)) {
      out.circle(at.x, at.y, 3, "class=\"rest\"");
      drawn.push_back(at);
      room_.occupy(Frame{at.x - 4, at.y - 4, 8, 8});
    }
  }
}

void TopicView::draw_number(base::SvgPart& out, const TopicSample& sample, const std::string& number) {
  const Pixel at = place(sample);
  const double width = std::max(16.0, text_width(number, 10) + 8);
  const Frame box = room_.find(at, width + 1, 17);
  const Pixel centre{box.left + (width + 1) / 2, box.top + 8.5};
  if (distance_of(centre, at) > 17) {
    base::svg_line(out, at.x, at.y, centre.x, centre.y, "leader");
  }
  out.rect(centre.x - width / 2, centre.y - 8, width, 16, "rx=\"8\" class=\"bubble\"");
  base::svg_text(out, centre.x, centre.y + 4, "middle", "number", number);
}

void draw_signal_mark(base::SvgPart& out, const Pixel& place, bool is_output, bool is_on, const std::string& colour) {
  using base::svg_number;
  const double x = place.x;
  const double y = place.y;
  const std::string shape = is_output
                                ? fmt::format("M{} {}l5.5 9.5h-11Z", svg_number(x), svg_number(y - 5.5))
                                : fmt::format("M{} {}l5.5 5.5l-5.5 5.5l-5.5 -5.5Z", svg_number(x), svg_number(y - 5.5));
  out.path(shape, fmt::format("class=\"mark\" stroke=\"{}\" fill=\"{}\"", colour, is_on ? colour : "#ffffff"));
}

double text_width(const std::string& text, double size) {
  return 0.62 * size * static_cast<double>(text.size());
}

double nice_step(double least) {
  const double ten = std::pow(10, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * ten >= least - 1e-9) {
      return factor * ten;
    }
  }
  return 10 * ten;
}

}  // namespace indurop::robot
