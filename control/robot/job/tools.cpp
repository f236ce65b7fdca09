// SPDX-License-Identifier: Apache-2.0
// Statements about tools: their declaration, and the selection of the tool that is held from here on.

#include <algorithm>
#include <string>
#include <utility>

#include "control/robot/job/near_name.h"
#include "control/robot/job/parser.h"

namespace indurop::robot {

// Parses "TOOL pen", "TOOL pen = POSE 0 0 120 RPY 0 0 0", "TOOL pen = POINTS A B C D", "TOOL grip = POSE ... MASS 2.5
// kg CENTRE 0 0 60"
void JobParser::tool() {
  const JobToken name = take();
  if (name.kind != JobToken::Kind::Word) {
    error(name, "expected the name of a tool, found " + shown(name));
    return;
  }
  if (!accept("=")) {
    add(Op::Tool);
    references_.push_back({JobReference::To::Tool, book_.jobs.size() - 1, job().steps.size() - 1,
                           std::string(name.text), line_, name.column});
    return;
  }
  Tool tool;
  tool.name = name.text;
  tool.file = job().file;
  tool.place = {static_cast<int>(line_), static_cast<int>(name.column)};
  if (tool_called(name.text) >= 0) {
    error(name, "there is already a tool " + in_quotes(name.text));
    return;
  }
  if (accept("POSE")) {
    pose(tool.tip);
  } else if (accept("POINTS")) {
    taught_tool(tool);
  } else {
    error(peek(), "expected POSE or POINTS, found " + shown(peek()) + "; TOOL " + tool.name +
                      " = POSE 0 0 120 RPY 0 0 0, or = POINTS A B C D");
  }
  if (!failed_ && accept("MASS")) {
    mass(tool.body);
  }
  if (!failed_) {
    book_.tools.push_back(std::move(tool));
  }
}

// Parses points at which its tip touches the same place; its orientation cannot be taught, only given.
void JobParser::taught_tool(Tool& tool) {
  tool.is_taught = true;
  const JobToken first = peek();
  std::size_t count = 0;
  for (; peek().kind == JobToken::Kind::Word && !same_word(peek().text, "RPY") && !same_word(peek().text, "MASS");
       ++count) {
    const JobToken point = take();
    accept(",");
    tool_points_.push_back({book_.tools.size(), book_.jobs.size() - 1, std::string(point.text), line_, point.column});
  }
  constexpr std::size_t kFewest = 3;
  constexpr std::size_t kMost = 32;
  if (count < kFewest || count > kMost) {
    error(first,
          "a tool is taught by 3 points or more, 32 at most, at which its tip touches the same place, turned "
          "otherwise each time; here are " +
              std::to_string(count));
  } else if (accept("RPY")) {
    double rpy[3];
    if (numbers(3, rpy, "roll, pitch and yaw in degrees")) {
      tool.tip.orientation = from_rpy({radians(rpy[0]), radians(rpy[1]), radians(rpy[2])});
    }
  }
  if (failed_) {
    tool_points_.resize(tool_points_.size() - count);
  }
}

int JobParser::tool_called(std::string_view name) const noexcept {
  const auto found =
      std::find_if(book_.tools.begin(), book_.tools.end(), [&](const Tool& each) { return each.name == name; });
  return found == book_.tools.end() ? -1 : static_cast<int>(found - book_.tools.begin());
}

void JobParser::resolve_tools() {
  for (const Declared& use : tool_points_) {
    const auto found = std::find_if(book_.points.begin(), book_.points.end(),
                                    [&](const Point& each) { return each.name == use.name; });
    if (found == book_.points.end() || found->target.is_pose) {
      error_in(book_.jobs[use.job].file, use.line, use.column,
               found == book_.points.end()
                   ? "there is no point '" + use.name + "'" + meant(use.name, names_of(book_.points))
                   : "point '" + use.name + "' is given as POSE; a tool is taught by points given as JOINT");
      continue;
    }
    book_.tools[use.owner].points.push_back(static_cast<int>(found - book_.points.begin()));
  }
  for (const Declared& use : frame_tools_) {
    const int tool = tool_called(use.name);
    if (tool < 0) {
      error_in(book_.jobs[use.job].file, use.line, use.column,
               no_such("tool", use.name, book_.tools, "TOOL", "POSE 0 0 120 RPY 0 0 0"));
    } else if (use.owner < book_.frames.size()) {
      book_.frames[use.owner].tool = tool;
    }
  }
}

}  // namespace indurop::robot
