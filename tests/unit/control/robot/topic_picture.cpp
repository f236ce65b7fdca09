// SPDX-License-Identifier: Apache-2.0
#include "topic_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/svg_style.h"
#include "topic_rows.h"
#include "topic_view.h"

namespace indurop::robot {
namespace {

constexpr double kWide = 700, kLeftOfViews = 62, kRightOfViews = 686;  // px
constexpr double kPadAcross = 40, kPadUp = 30;                         // px around the path, for labels
constexpr double kLevelNames = 58;                                     // px
constexpr double kBelow = 36;                                          // px for the numbers below a view

constexpr const char* kTopicStyle =
    ".caption{font-size:12px;font-weight:bold}.row{font-size:11px}.point{font-size:11px;font-weight:bold}"
    ".number{font-size:10px;font-weight:bold;fill:#fff}.bubble{fill:#22303c;stroke:#fff}"
    ".frame{fill:none;stroke:#b9c3cb}path{stroke-linejoin:round}.way{fill:none;stroke-width:2.2;stroke-linecap:round}"
    ".band{fill:none;stroke-width:10;stroke-linecap:round}.arrow{stroke:#fff;stroke-width:.7}"
    ".cross{stroke:#22303c;stroke-width:1}.rest{fill:#fff;stroke:#22303c;stroke-width:1.3}.leader{stroke:#22303c}"
    ".level{stroke:#7d8a95;stroke-dasharray:5 3}.moment{stroke:#22303c;stroke-width:.8;stroke-dasharray:2 2}"
    ".base{stroke:#9aa6b0}.mark{stroke-width:1.5}.span{fill:#e4e9ed;stroke:#9aa6b0}"
    ".curve{fill:#dfe6ee;stroke:#22303c}.taught{stroke:#7d8a95;stroke-width:1.2;stroke-dasharray:6 4}";

struct Range {
  double least = 1e300, most = -1e300;
  void add(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  // At least 30 mm, so that a line is not a view without a height.
  [[nodiscard]] double length() const { return std::max(30.0, most - least); }
  [[nodiscard]] double first() const { return (least + most - length()) / 2; }
};

std::vector<TopicView> views_of(const PictureScript& script, const TopicTrace& trace, double top, double& bottom) {
  std::array<Range, 3> ranges;
  for (const TopicSample& sample : trace.samples) {
    for (std::size_t i = 0; i < 3; ++i) {
      ranges[i].add(sample.tip[i]);
    }
  }
  for (const auto& [name, tip] : trace.points) {
    for (std::size_t i = 0; i < 3; ++i) {
      ranges[i].add(tip[i]);
    }
  }
  const Range& across = ranges[script.across == 'x' ? 0 : 1];
  const Range& deep = ranges[script.across == 'x' ? 1 : 0];
  const Range& up = ranges[2];
  using Kind = TopicView::Kind;
  std::vector<TopicView> views;
  const auto view = [&](Kind kind, const Frame& frame, double scale) {
    const Range& vertical = kind == Kind::FromAbove ? deep : up;
    TopicView::Axes axes;
    axes.across = kind == Kind::OverTime ? 't' : script.across;
    axes.scale_up = scale;
    axes.first_up = vertical.first() - (frame.height - vertical.length() * scale) / 2 / scale;
    axes.scale = kind == Kind::OverTime ? (frame.width - 24) / trace.samples.back().time : scale;
    axes.first =
        kind == Kind::OverTime ? -8 / axes.scale : across.first() - (frame.width - across.length() * scale) / 2 / scale;
    views.emplace_back(kind, frame, axes);
    bottom = frame.top + frame.height + kBelow;
  };
  const double width = kRightOfViews - kLeftOfViews;
  const bool has_two = script.views == Views::SideAndAbove;
  if (has_two || script.views == Views::Side) {
    const double heights = up.length() + (has_two ? deep.length() : 0);
    const double scale = std::min({(width - 2 * kPadAcross) / across.length(), 300 / heights, 3.0});
    const double height = up.length() * scale + 2 * kPadUp;
    view(Kind::FromTheSide, {kLeftOfViews, top, width, height}, scale);
    if (has_two) {
      view(Kind::FromAbove, {kLeftOfViews, bottom, width, deep.length() * scale + 2 * kPadUp}, scale);
    }
  } else if (script.views == Views::AboveAndSide) {
    const double half = (width - 58) / 2;
    const double scale =
        std::min((half - 2 * kPadAcross) / across.length(), 300 / std::max(up.length(), deep.length()));
    const double height = std::max(up.length(), deep.length()) * scale + 2 * kPadUp;
    view(Kind::FromAbove, {kLeftOfViews, top, half, height}, scale);
    view(Kind::FromTheSide, {kRightOfViews - half, top, half, height}, scale);
  } else if (script.views == Views::SideAndHeight) {
    const double scale = std::min(260 / up.length(), 100 / across.length());
    const double height = up.length() * scale + 2 * kPadUp;
    view(Kind::FromTheSide, {kLeftOfViews, top, 150, height}, scale);
    view(Kind::OverTime, {kLeftOfViews + 208, top, width - 208 - kLevelNames, height}, scale);
  }
  return views;
}

double top_speed_of(const TopicTrace& trace) {
  double most = 1;
  for (const TopicSample& sample : trace.samples) {
    most = std::max(most, sample.speed);
  }
  const double step = nice_step(most / 8);
  return std::ceil(most / step - 0.01) * step;
}

constexpr double kRightOfRamp = 212;  // px

double draw_legend(base::SvgPart& out, double top, const PictureScript& script, double top_speed) {
  double x = 14;
  for (int i = 0; i < 60; ++i) {
    out.rect(x + 3 * i, top, 3.2, 9, fmt::format("fill=\"{}\"", speed_colour(i / 59.0)));
  }
  base::svg_text(out, x, top + 21, "start", "label", "0");
  base::svg_text(out, x + 90, top + 21, "middle", "label", fmt::format("{:g}", top_speed / 2));
  base::svg_text(out, x + 180, top + 21, "end", "label", fmt::format("{:g} mm/s", top_speed));
  x = kRightOfRamp;
  double y = top + 5;
  const auto entry = [&](const std::string& text, const auto& draw) {
    const double width = 18 + text_width(text, 11);
    if (x + width > kRightOfViews) {
      x = kRightOfRamp;
      y += 18;
    }
    draw(Pixel{x + 7, y});
    base::svg_text(out, x + 17, y + 4, "start", "row", text);
    x += width + 8;
  };
  entry("at rest", [&](const Pixel& at) { out.circle(at.x, at.y, 3, "class=\"rest\""); });
  for (const ShownSignal& signal : script.signals) {
    for (const bool on : {true, false}) {
      if (signal.is_curve) {
        break;
      }
      entry(signal.name + (on ? " on" : " off"),
            [&](const Pixel& at) { draw_signal_mark(out, at, signal.is_output, on, signal.colour); });
    }
    if (signal.has_band) {
      entry("while " + signal.name + (signal.is_curve ? " is not 0" : " is on"), [&](const Pixel& at) {
        out.rect(at.x - 9, at.y - 5, 17, 10, fmt::format("rx=\"5\" fill=\"{}\" fill-opacity=\".3\"", signal.colour));
      });
    }
  }
  return y + 22;
}

// Places at which the same signal does the same are marked once.
void draw_marks(base::SvgPart& out, TopicView& view, const ShownSignal& signal, const TopicTrace& trace) {
  for (const bool on : {true, false}) {
    std::vector<Pixel> drawn;
    for (const std::size_t i : trace.edges(signal.name, on)) {
      const Pixel at = view.place(trace.samples[i]);
      if (std::none_of(drawn.begin(), drawn.end(),
                       [&](const Pixel& other) { return std::hypot(other.x - at.x, other.y - at.y) < 4; })) {
        view.draw_mark(out, trace.samples[i], signal.is_output, on, signal.colour);
        drawn.push_back(at);
      }
    }
  }
}

// "1-3, 5"
std::string ranges_of(const std::vector<std::size_t>& numbers) {
  std::string text;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) {
      ++last;
    }
    text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[i]);
    if (last > i) {
      text += fmt::format("{}{}", last > i + 1 ? "-" : ", ", numbers[last]);
    }
    i = last;
  }
  return text;
}

void draw_view(base::SvgPart& out, TopicView& view, const PictureScript& script, const TopicTrace& trace,
               const std::vector<std::size_t>& remarks, double top_speed) {
  view.draw_axes(out);
  for (const ShownSignal& signal : script.signals) {
    if (signal.has_band) {
      out.raw("<g opacity=\".3\">\n");
      view.draw_band(out, trace, signal.name, signal.colour);
      out.raw("</g>\n");
    }
  }
  for (const auto& [from, to] : script.taught) {
    view.draw_taught(out, trace, from, to);
  }
  view.draw_path(out, trace, top_speed);
  view.draw_rests(out, trace);
  for (const ShownSignal& signal : script.signals) {
    if (!signal.is_curve) {
      draw_marks(out, view, signal, trace);
    }
  }
  view.draw_points(out, trace);
  // Those of one place have one label.
  std::vector<std::pair<std::size_t, std::vector<std::size_t>>> labels;
  for (std::size_t i = 0; i < remarks.size(); ++i) {
    const Pixel at = view.place(trace.samples[remarks[i]]);
    const auto same = std::find_if(labels.begin(), labels.end(), [&](const auto& label) {
      const Pixel other = view.place(trace.samples[label.first]);
      return std::hypot(other.x - at.x, other.y - at.y) < 3;
    });
    if (same == labels.end()) {
      labels.push_back({remarks[i], {i + 1}});
    } else {
      same->second.push_back(i + 1);
    }
  }
  for (const auto& [sample, numbers] : labels) {
    view.draw_number(out, trace.samples[sample], ranges_of(numbers));
  }
}

std::vector<std::string> wrapped(const std::string& text, double width) {
  std::vector<std::string> lines{""};
  std::string word;
  for (const char c : text + " ") {
    if (c != ' ') {
      word += c;
      continue;
    }
    if (text_width(lines.back() + word, 11) > width) {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    word.clear();
  }
  return lines;
}

double draw_remarks(base::SvgPart& out, double top, const PictureScript& script, const TopicTrace& trace,
                    const std::vector<std::size_t>& remarks) {
  for (std::size_t i = 0; i < remarks.size(); ++i) {
    const TopicSample& at = trace.samples[remarks[i]];
    out.circle(24, top + 9, 8, "class=\"bubble\"");
    base::svg_text(out, 24, top + 13, "middle", "number", std::to_string(i + 1));
    base::svg_text(out, 80, top + 13, "end", "label", fmt::format("{:.2f} s", at.time));
    const std::string text = fmt::format(fmt::runtime(script.remarks[i].text), fmt::arg("x", std::lround(at.tip[0])),
                                         fmt::arg("y", std::lround(at.tip[1])), fmt::arg("z", std::lround(at.tip[2])));
    for (const std::string& line : wrapped(text, kRightOfViews - 90)) {
      base::svg_text(out, 90, top + 13, "start", "row", line);
      top += 15;
    }
    top += 5;
  }
  return top;
}

}  // namespace

std::string picture_of(const PictureScript& script) {
  const auto topic =
      std::find_if(topics().begin(), topics().end(), [&](const Topic& known) { return known.name == script.topic; });
  std::vector<std::string> signals;
  for (const ShownSignal& signal : script.signals) {
    signals.push_back(signal.name);
  }
  const TopicTrace trace = trace_of(*topic, signals);
  std::vector<std::size_t> remarks;
  for (const Remark& remark : script.remarks) {
    const int at = trace.begin(remark.trigger, remark.nth);
    if (at < 0) {
      throw std::runtime_error(
          fmt::format("{}: '{}' does not happen {} times", script.topic, remark.trigger, remark.nth));
    }
    remarks.push_back(static_cast<std::size_t>(at));
  }
  const double top_speed = top_speed_of(trace);
  base::SvgPart out;
  base::svg_text(out, 14, 28, "start", "head", script.title);
  double top = 46;
  if (script.views != Views::None) {
    top = draw_legend(out, top, script, top_speed);
  }
  top += 8;
  double bottom = top;
  for (TopicView& view : views_of(script, trace, top, bottom)) {
    draw_view(out, view, script, trace, remarks, top_speed);
  }
  bottom = draw_rows(out, bottom, script, trace, remarks, top_speed);
  bottom = draw_remarks(out, bottom + 8, script, trace, remarks);
  const std::string head = ".head{font-size:16px;font-weight:bold}";
  return base::svg_document(static_cast<int>(kWide), static_cast<int>(std::ceil(bottom + 8)), out,
                            std::string(base::kSvgStyle) + kTopicStyle + head);
}

}  // namespace indurop::robot
