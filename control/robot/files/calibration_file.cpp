// SPDX-License-Identifier: Apache-2.0
#include "control/robot/files/calibration_file.h"

#include <algorithm>
#include <array>

#include "control/robot/job/line.h"
#include "control/robot/job/near_name.h"
#include "control/robot/job/point_lines.h"

namespace indurop::robot {
namespace {

constexpr int kDecimals = 6;  // of what is calculated again

std::string words_of(const std::vector<MarkWord>& marks) {
  std::string out;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    out += (i == 0 ? "" : i + 1 == marks.size() ? " or " : ", ") + std::string(marks[i].word);
  }
  return out;
}

// Reads the lines of one file.
class PointReader {
 public:
  PointReader(base::Diagnostics& errors, CalibrationKind kind, const Arm& arm, const JobBook& book)
      : line_(errors), kind_(kind), marks_(marks_of(kind)), arm_(arm), book_(book) {}

  void begin(const std::string& file) { line_.begin(file); }
  // Returns the point of a line; none: it is empty or wrong.
  std::optional<MarkedPoint> point(std::string_view text);

 private:
  [[nodiscard]] bool of_arm() const { return kind_ == CalibrationKind::Tool || kind_ == CalibrationKind::HandCamera; }
  void seen(Pose& to);
  void place(Pose& to);
  void touched_by(Joints& joints, Pose& to);
  // The text between two columns.
  [[nodiscard]] std::string between(std::size_t from, std::size_t to) const;

  JobLine line_;
  CalibrationKind kind_;
  std::vector<MarkWord> marks_;
  const Arm& arm_;
  const JobBook& book_;
  std::string_view text_;
};

std::string PointReader::between(std::size_t from, std::size_t to) const {
  std::string_view part = text_.substr(from - 1, to - from);
  while (!part.empty() && (part.back() == ' ' || part.back() == '\t' || part.back() == '\r')) {
    part.remove_suffix(1);
  }
  return std::string(part);
}

std::optional<MarkedPoint> PointReader::point(std::string_view text) {
  text_ = text;
  line_.next(text);
  if (line_.at_end()) {
    return std::nullopt;
  }
  MarkedPoint out;
  const JobToken word = line_.take();
  const auto mark =
      std::find_if(marks_.begin(), marks_.end(), [&](const MarkWord& one) { return same_word(one.word, word.text); });
  if (mark == marks_.end()) {
    line_.error(word, "expected " + words_of(marks_) + ", found " + JobLine::shown(word));
    return std::nullopt;
  }
  out.mark = *mark;
  out.measured.mark = mark->mark;
  out.line = static_cast<int>(line_.number());
  if (mark->mark == Mark::Seen) {
    const std::size_t from = line_.peek().column;
    seen(out.measured.seen);
    out.seen = line_.failed() ? std::string() : between(from, line_.peek().column);
    if (!line_.failed() && !line_.accept("AT")) {
      line_.error(line_.peek(), "expected AT and where it was touched, found " + JobLine::shown(line_.peek()));
    }
  }
  if (line_.failed()) {
    return std::nullopt;
  }
  const std::size_t from = line_.peek().column;
  place(out.measured.at);
  if (!line_.failed()) {
    out.place = between(from, line_.peek().column);
    line_.expect_end();
  }
  return line_.failed() ? std::nullopt : std::optional(std::move(out));
}

// Parses "10 20", "10 20 5", "10 20 5 RPY 0 0 90".
void PointReader::seen(Pose& to) {
  std::array<double, 3> at{};
  if (!line_.numbers(2, at.data(), "x y of what the camera saw, in mm")) {
    return;
  }
  const bool flat = line_.peek().kind != JobToken::Kind::Number && line_.peek().text != ",";
  if (!flat && !line_.numbers(1, &at[2], "z of what the camera saw, in mm")) {
    return;
  }
  to.position = Vec3(at[0], at[1], at[2]) / 1000;
  const bool is_turned = line_.accept("RPY");
  if (is_turned) {
    line_.rpy(to.orientation);
  } else if (kind_ == CalibrationKind::HandCamera) {
    line_.error(line_.peek(), "expected RPY and the orientation of what the camera saw: a camera on the arm needs it");
  }
}

void PointReader::place(Pose& to) {
  if (line_.accept("POSE")) {
    line_.pose(to);
    return;
  }
  if (!line_.accept("JOINT")) {
    line_.error(line_.peek(), "expected JOINT and the positions of the axes, or POSE x y z RPY r p y, found " +
                                  JobLine::shown(line_.peek()));
    return;
  }
  std::array<double, kAxes> numbers{};
  if (!line_.numbers(arm_.count(), numbers.data(), "the positions of the axes in degrees, mm if they slide")) {
    return;
  }
  Joints joints = joints_of_values(arm_, numbers);
  touched_by(joints, to);
}

// Parses "TOOL tip" after the positions of the axes, or nothing.
void PointReader::touched_by(Joints& joints, Pose& to) {
  const JobToken word = line_.peek();
  if (!line_.accept("TOOL")) {
    to = arm_.forward(joints);
    return;
  }
  if (of_arm()) {
    line_.error(word, "no tool counts here: the positions are those of the arm's end");
    return;
  }
  const JobToken name = line_.take();
  const Tool* const tool = named(book_.tools, name.text);
  if (tool == nullptr) {
    line_.error(name, "there is no tool " + JobLine::shown(name) + meant(name.text, names_of(book_.tools)));
    return;
  }
  to = arm_.with_tool(tool->tip).forward(joints);
}

std::size_t count_of(const std::vector<MarkedPoint>& points, Mark mark) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [mark](const MarkedPoint& one) { return one.mark.mark == mark; }));
}

std::string of_four(std::size_t count) {
  return ", point " + std::to_string(count + 1) + " of 4";
}

}  // namespace

std::vector<MarkWord> marks_of(CalibrationKind kind) {
  switch (kind) {
    case CalibrationKind::Tool:
      return {{Mark::Tip, "TIP"}, {Mark::AlongX, "X"}, {Mark::PlaneXZ, "XZ"}};
    case CalibrationKind::Frame:
      return {{Mark::Origin, "ORIGIN"}, {Mark::OnX, "X"}, {Mark::PlaneXY, "XY"}};
    case CalibrationKind::Camera:
    case CalibrationKind::HandCamera:
      break;
  }
  return {{Mark::Seen, "SEEN"}};
}

CalibrationFile parse_calibration(const std::string& file, std::string_view text, CalibrationKind kind, const Arm& arm,
                                  const JobBook& book) {
  CalibrationFile out;
  base::Diagnostics errors(file, out.errors);
  PointReader reader(errors, kind, arm, book);
  reader.begin(file);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (auto point = reader.point(text.substr(0, end))) {
      out.points.push_back(std::move(*point));
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

std::pair<std::string, std::string> next_point(CalibrationKind kind, const std::vector<MarkedPoint>& points) {
  constexpr std::size_t kLeast = 4;
  switch (kind) {
    case CalibrationKind::Tool:
      if (const std::size_t count = count_of(points, Mark::Tip); count < kLeast) {
        return {"TIP", "touch the fixed tip with the tip of the tool" + of_four(count) +
                           (count == 0 ? "" : "; turn the tool by 30 degrees or more, about another axis each time")};
      }
      if (count_of(points, Mark::AlongX) == 0 && count_of(points, Mark::PlaneXZ) > 0) {
        return {"X",
                "move the tool so that the fixed tip lies on its +x axis, 100 mm or more from the tip of the tool"};
      }
      if (count_of(points, Mark::AlongX) > 0 && count_of(points, Mark::PlaneXZ) == 0) {
        return {"XZ",
                "move the tool so that the fixed tip lies in the plane of its x and z axes, on the side of +z, "
                "100 mm or more from the x axis"};
      }
      break;
    case CalibrationKind::Frame:
      if (count_of(points, Mark::Origin) == 0) {
        return {"ORIGIN", "touch the origin of the frame"};
      }
      if (count_of(points, Mark::OnX) == 0) {
        return {"X", "touch a place on the x axis, as far from the origin as possible"};
      }
      if (count_of(points, Mark::PlaneXY) == 0) {
        return {"XY", "touch a place in the plane of x and y, on the side of +y, far from the x axis"};
      }
      break;
    case CalibrationKind::Camera:
      if (const std::size_t count = count_of(points, Mark::Seen); count < kLeast) {
        return {"SEEN", "touch a mark that the camera saw, and state where it saw it" + of_four(count)};
      }
      break;
    case CalibrationKind::HandCamera:
      if (const std::size_t count = count_of(points, Mark::Seen); count < kLeast) {
        return {"SEEN",
                "let the camera see the mark, and state its pose" + of_four(count) +
                    (count == 0 ? "" : "; turn the camera by 30 degrees or more, about another axis each time")};
      }
  }
  return {};
}

std::string without_line(std::string_view text, int line) {
  std::string out;
  for (int at = 1; !text.empty(); ++at) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    out += at == line ? std::string_view() : text.substr(0, end);
    text.remove_prefix(end);
  }
  return out;
}

std::string calibration_line(const Arm& arm, std::string_view mark, const std::vector<double>& seen,
                             const Joints& joints, const std::string& tool) {
  std::string out(mark);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    out += (i == 3 ? " RPY " : " ") + decimal_text(seen[i], kDecimals);
  }
  out += seen.empty() ? " JOINT" : " AT JOINT";
  for (int i = 0; i < arm.count(); ++i) {
    out += ' ' + decimal_text(arm.axis(i).slides() ? 1000 * joints[i] : degrees(joints[i]), kDecimals);
  }
  return out + (tool.empty() ? "" : " TOOL " + tool);
}

}  // namespace indurop::robot
