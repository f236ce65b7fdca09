// SPDX-License-Identifier: Apache-2.0
#include "control/plc/print/chart_svg.h"

#include <fmt/format.h>

#include <algorithm>

#include "control/plc/draw/shape.h"
#include "control/plc/draw/svg_symbols.h"
#include "control/plc/print/chart_layout.h"
#include "control/plc/print/chart_text.h"

namespace indurop::plc {
namespace {

constexpr int kCharacter = 8;   // width of one
constexpr int kStep = 30;       // height of a step
constexpr int kAction = 22;     // height of a line of actions
constexpr int kBar = 13;        // half the width of a transition
constexpr int kBetween = 42;    // between rows: lines and branches
constexpr int kBranch = 15;     // below a node its branch, above a node its joint
constexpr int kColumnGap = 36;  // between columns
constexpr const char* kLine = R"(stroke="#1F2D3D" stroke-width="1.6" stroke-linecap="square")";

int width_of(std::string_view text) {
  return kCharacter * draw::text_width(text);
}

class ChartDrawing {
 public:
  explicit ChartDrawing(const network::Chart& chart) : chart_(chart), layout_(lay_out_chart(chart)) {}

  draw::SvgPart run() {
    measure();
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      branch(i);
      step(i);
    }
    for (std::size_t i = 0; i < chart_.transitions.size(); ++i) {
      together(i);
      onwards(i);
      transition(i);
    }
    return {std::move(out_), width_, rows_.back() + kBetween};
  }
  [[nodiscard]] const std::vector<StepBox>& boxes() const noexcept { return boxes_; }

 private:
  [[nodiscard]] int half_step(std::size_t i) const { return std::max(width_of(chart_.steps[i].name) + 20, 64) / 2; }
  [[nodiscard]] std::vector<const network::ActionLine*> actions_of(std::size_t step) const {
    std::vector<const network::ActionLine*> lines;
    for (const network::Association& each : chart_.actions) {
      if (each.step == step) {
        lines.push_back(each.line);
      }
    }
    return lines;
  }
  static std::string qualifier_of(const network::ActionLine& line) {
    return line.duration.empty() ? line.qualifier : line.qualifier + " " + line.duration;
  }
  static int width_of_actions(const std::vector<const network::ActionLine*>& lines, int& qualifiers) {
    int texts = 0;
    for (const network::ActionLine* line : lines) {
      qualifiers = std::max(qualifiers, width_of(qualifier_of(*line)) + 14);
      texts = std::max(texts, width_of(action_text(*line)) + 16);
    }
    return qualifiers + texts;
  }

  // Computes positions of columns (their middle line) and rows (their top).
  void measure() {
    std::vector<int> left(layout_.columns, 40);
    std::vector<int> right(layout_.columns, 40);
    std::vector<int> height(layout_.rows, 6);
    for (std::size_t i = 0; i < chart_.steps.size(); ++i) {
      const ChartSpot& spot = layout_.steps[i];
      const auto lines = actions_of(i);
      int qualifiers = 0;
      const int actions_width = lines.empty() ? 0 : 24 + width_of_actions(lines, qualifiers);
      left[spot.column] = std::max(left[spot.column], half_step(i));
      right[spot.column] = std::max(right[spot.column], half_step(i) + actions_width);
      height[spot.row] = std::max({height[spot.row], kStep, static_cast<int>(lines.size()) * kAction});
    }
    for (std::size_t i = 0; i < chart_.transitions.size(); ++i) {
      const ChartSpot& spot = layout_.transitions[i];
      right[spot.column] =
          std::max(right[spot.column], kBar + 8 + width_of(condition_text(*chart_.transitions[i].element)));
      for (const std::size_t to : chart_.transitions[i].to) {
        right[spot.column] = std::max(right[spot.column], 20 + width_of(chart_.steps[to].name));
      }
    }
    int x = 0;
    for (std::size_t i = 0; i < layout_.columns; ++i) {
      columns_.push_back(x + left[i]);
      x += left[i] + right[i] + kColumnGap;
    }
    width_ = x;
    int y = 4;
    for (const int each : height) {
      rows_.push_back(y);
      y += each + kBetween;
    }
    rows_.push_back(y);
  }

  [[nodiscard]] int x_of(const ChartSpot& spot) const { return columns_[spot.column]; }
  [[nodiscard]] int y_of(const ChartSpot& spot) const { return rows_[spot.row]; }
  [[nodiscard]] int below_step(std::size_t i) const { return y_of(layout_.steps[i]) + kStep; }
  [[nodiscard]] int bar_of(std::size_t transition) const { return y_of(layout_.transitions[transition]) + 3; }

  void line(int x1, int y1, int x2, int y2) {
    if (x1 == x2 && y1 == y2) {
      return;
    }
    out_.line(x1, y1, x2, y2, kLine);
  }
  // Draws the line where simultaneous branches begin or end.
  void double_line(int x1, int x2, int y) {
    line(std::min(x1, x2) - 10, y - 2, std::max(x1, x2) + 10, y - 2);
    line(std::min(x1, x2) - 10, y + 2, std::max(x1, x2) + 10, y + 2);
  }
  void step(std::size_t i) {
    const int x = x_of(layout_.steps[i]);
    const int y = y_of(layout_.steps[i]);
    const int half = half_step(i);
    boxes_.push_back({x - half, y, 2 * half, kStep});
    out_.rect(x - half, y, 2 * half, kStep, R"(fill="#F2F6FB" stroke="#2B4C7E" stroke-width="1.6")");
    if (chart_.steps[i].initial) {
      out_.rect(x - half + 4, y + 4, 2 * half - 8, kStep - 8, R"(fill="none" stroke="#2B4C7E" stroke-width="1.2")");
    }
    const int middle = y + kStep / 2;
    out_.text(x, middle + 4, chart_.steps[i].name, R"(text-anchor="middle" font-weight="bold" fill="#2B4C7E")");
    const auto lines = actions_of(i);
    if (lines.empty()) {
      return;
    }
    line(x + half, middle, x + half + 24, middle);
    int qualifiers = 0;
    const int width = width_of_actions(lines, qualifiers);
    int top = y + (lines.size() == 1 ? (kStep - kAction) / 2 : 0);
    for (const network::ActionLine* each : lines) {
      out_.rect(x + half + 24, top, width, kAction, R"(fill="#FFF8EC" stroke="#8A4B08")");
      line(x + half + 24 + qualifiers, top, x + half + 24 + qualifiers, top + kAction);
      const int centre = x + half + 24 + qualifiers / 2;
      out_.text(centre, top + 15, qualifier_of(*each), R"(text-anchor="middle" fill="#8A4B08")");
      out_.text(x + half + 24 + qualifiers + 8, top + 15, action_text(*each), R"(fill="#0B4A8F")");
      top += kAction;
    }
  }

  // Draws from a step to the transitions that leave it alone: one of them is taken.
  void branch(std::size_t i) {
    const int x = x_of(layout_.steps[i]);
    for (std::size_t t = 0; t < chart_.transitions.size(); ++t) {
      if (chart_.transitions[t].from != std::vector<std::size_t>{i}) {
        continue;
      }
      const int to = x_of(layout_.transitions[t]);
      const int y =
          below_step(i) + (bar_of(t) - below_step(i) > kBetween + 3 ? bar_of(t) - below_step(i) - kBranch : kBranch);
      line(x, below_step(i), x, y);
      line(x, y, to, y);
      line(to, y, to, bar_of(t));
    }
  }

  // Draws from several steps to the transition that leaves them all.
  void together(std::size_t t) {
    const auto& from = chart_.transitions[t].from;
    if (from.size() < 2) {
      return;
    }
    const int y = bar_of(t) - kBranch;
    int least = x_of(layout_.transitions[t]);
    int most = least;
    for (const std::size_t step : from) {
      const int x = x_of(layout_.steps[step]);
      line(x, below_step(step), x, y);
      least = std::min(least, x);
      most = std::max(most, x);
    }
    double_line(least, most, y);
    line(x_of(layout_.transitions[t]), y, x_of(layout_.transitions[t]), bar_of(t));
  }

  void onwards(std::size_t t) {
    const auto& to = chart_.transitions[t].to;
    int x = x_of(layout_.transitions[t]);
    int y = bar_of(t);
    if (to.size() > 1) {
      line(x, y, x, y + kBranch);
      y += kBranch;
    }
    int most = x;
    for (std::size_t k = 0; k < to.size(); ++k) {
      const ChartSpot& target = layout_.steps[to[k]];
      const bool below = !layout_.jumps[t][k];
      const int from =
          to.size() > 1 && below ? x_of(target) : x + (to.size() > 1 ? static_cast<int>(k) * kColumnGap : 0);
      most = std::max(most, from);
      if (below) {
        const int joint = y_of(target) - kBranch + 3;
        line(from, y, from, std::max(joint, y));
        line(from, std::max(joint, y), x_of(target), std::max(joint, y));
        line(x_of(target), std::max(joint, y), x_of(target), y_of(target));
      } else {
        jump(from, y, chart_.steps[to[k]].name);
      }
    }
    if (to.size() > 1) {
      double_line(x, most, y);
    }
  }

  // Draws an arrow with the name of the step.
  void jump(int x, int y, const std::string& name) {
    line(x, y, x, y + 14);
    out_.path(fmt::format("M{} {}h12l-6 8z", x - 6, y + 14), R"(fill="#1F2D3D")");
    out_.text(x + 11, y + 22, name, R"(font-weight="bold" fill="#2B4C7E")");
  }

  void transition(std::size_t t) {
    const int x = x_of(layout_.transitions[t]);
    out_.line(x - kBar, bar_of(t), x + kBar, bar_of(t), R"(stroke="#1F2D3D" stroke-width="4")");
    out_.text(x + kBar + 8, bar_of(t) + 4, condition_text(*chart_.transitions[t].element), R"(fill="#1F2D3D")");
  }

  const network::Chart& chart_;
  ChartLayout layout_;
  std::vector<StepBox> boxes_;
  std::vector<int> columns_;
  std::vector<int> rows_;
  int width_ = 0;
  base::SvgPart out_;
};

}  // namespace

draw::SvgPart draw_chart(const network::Chart& chart, std::vector<StepBox>* boxes) {
  ChartDrawing drawing(chart);
  draw::SvgPart part = drawing.run();
  if (boxes != nullptr) {
    *boxes = drawing.boxes();
  }
  return part;
}

}  // namespace indurop::plc
