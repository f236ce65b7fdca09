// SPDX-License-Identifier: Apache-2.0
// Statements about places: work frames, and offsets from points.

#include <algorithm>
#include <string>
#include <utility>

#include "control/robot/job/near_name.h"
#include "control/robot/job/parser.h"

namespace indurop::robot {

// Parses "FRAME pallet = POSE 500 0 100 RPY 0 0 45", "FRAME pallet = POINTS O X Y"
void JobParser::frame() {
  const JobToken name = take();
  if (name.kind != JobToken::Kind::Word || !accept("=")) {
    error(name.kind != JobToken::Kind::Word ? name : peek(),
          "expected a name and '='; FRAME pallet = POSE 500 0 100 RPY 0 0 45, or = POINTS origin on_x beside_y");
    return;
  }
  WorkFrame frame;
  frame.name = name.text;
  frame.file = job().file;
  frame.place = {static_cast<int>(line_), static_cast<int>(name.column)};
  const bool known = std::any_of(book_.frames.begin(), book_.frames.end(),
                                 [&](const WorkFrame& each) { return each.name == frame.name; });
  if (known) {
    error(name, "there is already a frame " + in_quotes(name.text));
    return;
  }
  if (accept("POSE")) {
    if (!pose(frame.pose)) {
      return;
    }
  } else if (accept("POINTS")) {
    frame.is_taught = true;
    for (int i = 0; i < 3 && !failed_; ++i) {
      const JobToken point = take();
      accept(",");
      if (point.kind != JobToken::Kind::Word) {
        error(point, "expected three points: the origin, one on x, one on the side of y; found " + shown(point));
        return;
      }
      frame_points_.push_back(
          {book_.frames.size(), book_.jobs.size() - 1, std::string(point.text), line_, point.column});
    }
    if (accept("TOOL")) {
      const JobToken tool = take();
      frame_tools_.push_back({book_.frames.size(), book_.jobs.size() - 1, std::string(tool.text), line_, tool.column});
    }
  } else {
    error(peek(), "expected POSE or POINTS, found " + shown(peek()));
    return;
  }
  book_.frames.push_back(std::move(frame));
}

// Parses "OFFSET 0, 0, 100", "OFFSET TOOL 0, 0, -50"
void JobParser::offset() {
  const bool by_tool = accept("TOOL");
  int first = -1;
  for (int i = 0; i < 3 && !failed_; ++i) {
    // Without the comma "0 -50" would be one number.
    if (i > 0 && !accept(",")) {
      error(peek(), "expected ',', found " + shown(peek()) + "; OFFSET 0, 0, -50");
      return;
    }
    const int formula = expression("x, y and z of the offset in mm");
    first = i == 0 ? formula : first;
  }
  job().steps.back().formula = first;
  job().steps.back().by_tool = by_tool;
}

void JobParser::resolve_frames() {
  const auto point_called = [this](const std::string& name) {
    const auto found =
        std::find_if(book_.points.begin(), book_.points.end(), [&](const Point& each) { return each.name == name; });
    return found == book_.points.end() ? -1 : static_cast<int>(found - book_.points.begin());
  };
  for (const Declared& use : point_frames_) {
    const auto found = std::find_if(book_.frames.begin(), book_.frames.end(),
                                    [&](const WorkFrame& each) { return each.name == use.name; });
    if (found == book_.frames.end()) {
      error_in(book_.jobs[use.job].file, use.line, use.column,
               no_such("frame", use.name, book_.frames, "FRAME", "POSE 500 0 100 RPY 0 0 45"));
      continue;
    }
    book_.points[use.owner].frame = static_cast<int>(found - book_.frames.begin());
  }
  for (std::size_t i = 0; i < frame_points_.size(); ++i) {
    const Declared& use = frame_points_[i];
    const int point = point_called(use.name);
    if (point < 0 || book_.points[static_cast<std::size_t>(point)].frame >= 0) {
      error_in(book_.jobs[use.job].file, use.line, use.column,
               point < 0
                   ? "there is no point '" + use.name + "'" + meant(use.name, names_of(book_.points))
                   : "point '" + use.name + "' is given in a frame itself; a frame is taught by points of the base");
      continue;
    }
    if (use.owner < book_.frames.size()) {
      book_.frames[use.owner].points[i % 3] = point;
    }
  }
}

}  // namespace indurop::robot
