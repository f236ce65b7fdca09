// SPDX-License-Identifier: Apache-2.0
// One view of the path of a tool: from above, from the side, or its height over time.

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/base/svg.h"
#include "topic_trace.h"

namespace indurop::robot {

struct Pixel {
  double x = 0, y = 0;
};

struct Frame {  // of a view or a row, px
  double left = 0, top = 0, width = 0, height = 0;
};

// Finds room for labels next to what they describe.
class LabelRoom {
 public:
  explicit LabelRoom(const Frame& frame);
  void occupy(const Pixel& path);
  void occupy(const Frame& box);
  // Returns where a label of this size hides least, and occupies it. Far away from `place`, it needs a line to it.
  Frame find(const Pixel& place, double width, double height);

 private:
  static constexpr double kCell = 2;  // px
  [[nodiscard]] double cost(const Frame& box) const;

  Frame frame_;
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> path_;
  std::vector<Frame> boxes_;
};

// Colours of speeds, from rest to the highest one of a picture.
[[nodiscard]] std::string speed_colour(double part);

class TopicView {
 public:
  enum class Kind : std::uint8_t { FromTheSide, FromAbove, OverTime };
  struct Axes {
    char across = 'y';               // horizontal: x, y, or t for seconds
    double first = 0, first_up = 0;  // value at the left, and at the bottom (from above, if y is across: at the top)
    double scale = 1, scale_up = 1;  // px per mm, or per s
  };
  TopicView(Kind kind, const Frame& frame, const Axes& axes);

  [[nodiscard]] Pixel place(const TopicSample& sample) const;
  [[nodiscard]] Pixel place(const std::array<double, 3>& tip, double time) const;
  // Grid, numbers and names of the axes, and what the view shows.
  void draw_axes(base::SvgPart& out);
  // The path while a signal is on, as a band below it.
  void draw_band(base::SvgPart& out, const TopicTrace& trace, const std::string& signal, const std::string& colour);
  void draw_path(base::SvgPart& out, const TopicTrace& trace, double top_speed);
  // The straight line between two points, as taught.
  void draw_taught(base::SvgPart& out, const TopicTrace& trace, const std::string& from, const std::string& to);
  void draw_points(base::SvgPart& out, const TopicTrace& trace);
  // A mark at a place of the path: a triangle for an output, a diamond for an input; full if it becomes on.
  void draw_mark(base::SvgPart& out, const TopicSample& sample, bool is_output, bool is_on, const std::string& colour);
  void draw_rests(base::SvgPart& out, const TopicTrace& trace);
  void draw_number(base::SvgPart& out, const TopicSample& sample, const std::string& number);
  [[nodiscard]] Kind kind() const noexcept { return kind_; }
  [[nodiscard]] const Frame& frame() const noexcept { return frame_; }

 private:
  void draw_arrows(base::SvgPart& out, const TopicTrace& trace, double top_speed);
  [[nodiscard]] std::string caption() const;
  [[nodiscard]] bool up_is_down() const { return kind_ == Kind::FromAbove && axes_.across == 'y'; }
  [[nodiscard]] bool shows(const Pixel& place) const;

  Kind kind_;
  Frame frame_;
  Axes axes_;
  LabelRoom room_;
  std::vector<std::pair<Pixel, std::string>> marks_;  // and what they mean
};

// Commands of an SVG path along these places, without those that are within a quarter of a pixel of the rest.
[[nodiscard]] std::string path_of(const std::vector<Pixel>& way);
// An output or an input on a path, as in the legend.
void draw_signal_mark(base::SvgPart& out, const Pixel& place, bool is_output, bool is_on, const std::string& colour);
// px of a text of this size.
[[nodiscard]] double text_width(const std::string& text, double size);
// 1, 2 or 5 times a power of ten, at least `least`.
[[nodiscard]] double nice_step(double least);

}  // namespace indurop::robot
