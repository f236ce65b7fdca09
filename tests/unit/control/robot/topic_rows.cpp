// SPDX-License-Identifier: Apache-2.0
#include "topic_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/svg_style.h"

namespace indurop::robot {
namespace {

constexpr double kLeftOfRows = 172, kRightOfRows = 686;  // px

std::string rounded(double value) {
  return fmt::format("{:g}", std::round(value * 100) / 100);
}

class TopicRows {
 public:
  TopicRows(base::SvgPart& out, double top, const TopicTrace& trace)
      : out_(out), trace_(trace), top_(top), end_(trace.samples.back().time) {}

  [[nodiscard]] double top() const { return top_; }
  [[nodiscard]] double x(std::size_t sample) const {
    return kLeftOfRows + (kRightOfRows - kLeftOfRows) * trace_.samples[sample].time / end_;
  }

  // Numbers, and lines from them through all rows, which end at `bottom`.
  void numbers(const std::vector<std::size_t>& samples, double bottom) {
    double free = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double at = x(samples[i]);
      const double centre = std::max(at, free);
      free = centre + 18;
      base::svg_line(out_, at, top_ + 18, at, bottom, "moment");
      out_.circle(centre, top_ + 9, 8, "class=\"bubble\"");
      base::svg_text(out_, centre, top_ + 13, "middle", "number", std::to_string(i + 1));
    }
    top_ += 22;
  }

  void curve(const std::string& name, double height, double most,
             const std::function<double(const TopicSample&)>& value) {
    label(name, height, 42);
    double least = 0;
    for (const TopicSample& sample : trace_.samples) {
      least = std::min(least, value(sample));
      most = std::max(most, value(sample));
    }
    const auto y = [&](double v) { return top_ + height - height * (v - least) / std::max(1e-9, most - least); };
    std::vector<Pixel> way{{kLeftOfRows, y(0)}};
    for (std::size_t i = 0; i < trace_.samples.size(); ++i) {
      way.push_back({x(i), y(value(trace_.samples[i])) + 0.0013});
    }
    way.push_back({kRightOfRows, y(0)});
    out_.path(path_of(way) + "Z", "class=\"curve\"");
    base::svg_text(out_, kLeftOfRows - 5, top_ + 8, "end", "label", rounded(most));
    base::svg_text(out_, kLeftOfRows - 5, top_ + height + 3, "end", "label", rounded(least));
    base::svg_line(out_, kLeftOfRows, y(0), kRightOfRows, y(0), "base");
    top_ += height + 10;
  }

  void bar(const std::string& name, const std::string& colour, const std::function<bool(const TopicSample&)>& is_on) {
    label(name, 12);
    base::svg_line(out_, kLeftOfRows, top_ + 12, kRightOfRows, top_ + 12, "base");
    spans([&](const TopicSample& sample) { return std::string(is_on(sample) ? "1" : ""); },
          [&](std::size_t from, std::size_t to, const std::string& /*what*/) {
            out_.rect(x(from), top_ + 1, std::max(1.5, x(to) - x(from)), 11, fmt::format("fill=\"{}\"", colour));
          });
    top_ += 18;
  }

  void names(const std::string& name, const std::function<std::string(const TopicSample&)>& what) {
    label(name, 14);
    spans(what, [&](std::size_t from, std::size_t to, const std::string& text) {
      const double width = x(to) - x(from);
      out_.rect(x(from), top_, std::max(1.0, width), 15, "class=\"span\"", text);
      if (text_width(text, 11) < width) {
        base::svg_text(out_, x(from) + width / 2, top_ + 11.5, "middle", "label", text);
      }
    });
    top_ += 21;
  }

  void seconds() {
    const double step = nice_step(50 * end_ / (kRightOfRows - kLeftOfRows));
    for (int k = 0; k * step <= end_; ++k) {
      const double at = kLeftOfRows + (kRightOfRows - kLeftOfRows) * k * step / end_;
      base::svg_line(out_, at, top_ - 4, at, top_, "base");
      base::svg_text(out_, std::min(at, kRightOfRows - 8), top_ + 12, "middle", "label",
                     fmt::format("{:g} s", k * step));
    }
    top_ += 20;
  }

 private:
  void label(const std::string& name, double height, double left = 8) {
    base::svg_text(out_, kLeftOfRows - left, top_ + height / 2 + 4, "end", "row", name);
  }

  void spans(const std::function<std::string(const TopicSample&)>& what,
             const std::function<void(std::size_t, std::size_t, const std::string&)>& draw) {
    std::size_t from = 0;
    for (std::size_t i = 1; i <= trace_.samples.size(); ++i) {
      const bool is_end = i == trace_.samples.size();
      if (is_end || what(trace_.samples[i]) != what(trace_.samples[from])) {
        if (const std::string text = what(trace_.samples[from]); !text.empty()) {
          draw(from, is_end ? i - 1 : i, text);
        }
        from = i;
      }
    }
  }

  base::SvgPart& out_;
  const TopicTrace& trace_;
  double top_;
  double end_;  // s
};

}  // namespace

double draw_rows(base::SvgPart& out, double top, const PictureScript& script, const TopicTrace& trace,
                 const std::vector<std::size_t>& remarks, double top_speed) {
  base::SvgPart content;  // above the lines of the remarks, which need to know where the rows end
  TopicRows rows(content, top + 22, trace);
  const auto any = [&](const auto& condition) {
    return std::any_of(trace.samples.begin(), trace.samples.end(), condition);
  };
  if (script.views != Views::None) {
    rows.curve("speed in mm/s", 44, top_speed,
               [&](const TopicSample& sample) { return std::min(sample.speed, top_speed); });
  }
  if (script.shows_axis) {
    rows.curve("axis 1 (rail) in mm", 36, 0, [](const TopicSample& sample) { return sample.axis; });
  }
  if (any([](const TopicSample& sample) { return sample.called != "main"; })) {
    rows.names("job",
               [&](const TopicSample& sample) { return sample.called == "main" ? script.topic : sample.called; });
  }
  for (const ShownSignal& signal : script.signals) {
    const std::string name = signal.name + (signal.meaning.empty() ? "" : " " + signal.meaning);
    const auto value = [&](const TopicSample& sample) { return sample.values.at(signal.name); };
    if (signal.is_curve) {
      rows.curve(name, 30, 0, value);
    } else {
      rows.bar(name, signal.colour, [&](const TopicSample& sample) { return value(sample) != 0; });
    }
  }
  if (script.views == Views::None) {
    rows.names("message", [](const TopicSample& sample) { return sample.message; });
  }
  if (any([](const TopicSample& sample) { return !sample.question.empty(); })) {
    rows.bar("a question is open", "#c08a1e", [](const TopicSample& sample) { return !sample.question.empty(); });
  }
  TopicRows(out, top, trace).numbers(remarks, rows.top() - 4);
  out.add(content);
  base::SvgPart scale;
  TopicRows bottom(scale, rows.top(), trace);
  bottom.seconds();
  out.add(scale);
  return bottom.top();
}

}  // namespace indurop::robot
