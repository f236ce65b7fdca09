// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/places.h"

#include <string>
#include <utility>

#include "control/robot/job/axis_word.h"

namespace indurop::robot {

void PlaceReader::point() {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word) {
    line_.error(name, "expected the name of the point, found " + JobLine::shown(name));
    return;
  }
  if (JobNames::is_special(name.text)) {
    line_.error(name, JobLine::shown(name) + " is a place that every job knows, so no point can have this name");
    return;
  }
  if (!line_.accept("=")) {
    line_.error(line_.peek(), "expected '=', found " + JobLine::shown(line_.peek()) + "; POINT " +
                                  std::string(name.text) + " = JOINT 0 0 0 0 0 0, or = POSE 500 0 300 RPY 180 0 0");
    return;
  }
  Target target;
  if (line_.accept("JOINT")) {
    joint_point(target);
  } else if (line_.accept("POSE")) {
    pose_point(target);
  } else {
    line_.error(line_.peek(), "expected JOINT or POSE, found " + JobLine::shown(line_.peek()));
  }
  const std::string text(name.text);
  const auto [found, fresh] = point_places_.try_emplace(text, line_.file() + ":" + std::to_string(line_.number()));
  if (!fresh) {
    line_.error(name, "there is already a point " + in_quotes(text) + " at " + found->second);
  }
  if (fresh && !line_.failed()) {
    draft_.book().points.push_back({text, target, line_.file(), line_.place(name), -1, Quat::Identity(), {}});
    draft_.book().points.back().axis_columns = axis_columns_;
  } else {
    names_.drop_frame_of(draft_.book().points.size());
  }
}

void PlaceReader::joint_point(Target& target) {
  double q[kAxes] = {};
  const bool usual = shape_.axes == 6 && shape_.slides == ArmShape{}.slides;
  if (line_.numbers(
          shape_.axes, q,
          usual ? "the angles of the six joints in degrees" : "one of each axis, degrees, mm where it slides")) {
    for (int i = 0; i < shape_.axes; ++i) {
      target.joints[i] = axis_value(i, q[i]);
    }
  }
}

void PlaceReader::pose_point(Target& target) {
  target.is_pose = true;
  axis_columns_ = {};
  if (!line_.pose(target.pose)) {
    return;
  }
  if (line_.accept("POSTURE")) {
    posture(target);
  }
  while (!line_.failed() && line_.accept("AXIS")) {
    held_axis(target);
  }
  if (!line_.failed() && line_.accept("IN")) {
    const JobToken name = line_.take();
    if (name.kind != JobToken::Kind::Word) {
      line_.error(name, "expected the name of a frame, found " + JobLine::shown(name));
      return;
    }
    names_.declare(JobNames::In::PointFrame, draft_.book().points.size(), name);
  }
}

void PlaceReader::posture(Target& target) {
  double posture = 0;
  if (!(line_.numbers(1, &posture, "the posture, 0 to 7") && posture >= 0 && posture <= 7 &&
        posture == std::floor(posture))) {
    line_.error(line_.before(),
                "a posture is a whole number from 0 to 7: 1 over the back, 2 other elbow, 4 wrist turned over, added");
    return;
  }
  target.posture = static_cast<std::uint8_t>(posture);
}

// Parses the axis that a pose leaves undetermined on arms with more than six axes.
void PlaceReader::held_axis(Target& target) {
  const int column = line_.place(line_.before()).column;
  const int axis = axis_number(line_, shape_, target.held);
  double value = 0;
  if (axis >= 0 && line_.numbers(1, &value, "where the axis is to stand")) {
    target.joints[axis] = axis_value(axis, value);
    target.held |= 1U << static_cast<unsigned>(axis);
    axis_columns_[at(axis)] = column;
  }
}

double PlaceReader::axis_value(int axis, double written) const noexcept {
  return shape_.slides[static_cast<std::size_t>(axis)] ? written / 1000 : radians(written);
}

// Parses "FRAME pallet = POSE 500 0 100 RPY 0 0 45", "FRAME pallet = POINTS O X Y", "FRAME f = MATCH P1 AT 10 20 0"
void PlaceReader::frame() {
  const JobToken name = line_.take();
  if (name.kind != JobToken::Kind::Word || !line_.accept("=")) {
    line_.error(name.kind != JobToken::Kind::Word ? name : line_.peek(),
                "expected a name and '='; FRAME pallet = POSE 500 0 100 RPY 0 0 45, or = POINTS origin on_x side_y");
    return;
  }
  WorkFrame frame;
  frame.name = name.text;
  frame.file = line_.file();
  frame.place = line_.place(name);
  if (frames_.contains(frame.name)) {
    line_.error(name, "there is already a frame " + in_quotes(name.text));
    return;
  }
  if (line_.accept("POSE")) {
    if (!line_.pose(frame.pose)) {
      return;
    }
  } else if (line_.accept("POINTS")) {
    frame.is_taught = true;
    frame_points();
  } else if (line_.accept("MATCH")) {
    frame.is_taught = true;
    matched_points(frame);
  } else {
    line_.error(line_.peek(), "expected POSE, POINTS or MATCH, found " + JobLine::shown(line_.peek()));
    return;
  }
  if (!line_.failed() && frame.is_taught && line_.accept("TOOL")) {
    const JobToken tool = line_.take();
    names_.declare(JobNames::In::FrameTool, draft_.book().frames.size(), tool);
  }
  if (line_.failed()) {
    return;
  }
  frames_.insert(frame.name);
  draft_.book().frames.push_back(std::move(frame));
}

void PlaceReader::frame_points() {
  for (int i = 0; i < 3 && !line_.failed(); ++i) {
    const JobToken point = line_.take();
    line_.accept(",");
    if (point.kind != JobToken::Kind::Word) {
      line_.error(point,
                  "expected three points: the origin, one on x, one on the side of y; found " + JobLine::shown(point));
      return;
    }
    names_.declare(JobNames::In::FramePoint, draft_.book().frames.size(), point);
  }
}

// Parses "P1 AT 12.5 30 0, P2 AT 90 30 0, P3 AT 90 110 0"
void PlaceReader::matched_points(WorkFrame& frame) {
  constexpr std::size_t kMost = 32;
  const JobToken start = line_.before();
  while (!line_.failed() && line_.peek().kind == JobToken::Kind::Word && !same_word(line_.peek().text, "TOOL")) {
    names_.declare(JobNames::In::FrameMatch, draft_.book().frames.size(), line_.take());
    double place[3] = {};
    if (!line_.accept("AT")) {
      line_.error(line_.peek(), "expected AT and x y z of the point in the frame, found " +
                                    JobLine::shown(line_.peek()) +
                                    "; MATCH P1 AT 12.5 30 0, P2 AT 90 30 0, P3 AT 90 110 0");
    } else if (line_.numbers(3, place, "x y z of the point in the frame, mm")) {
      frame.in_frame.emplace_back(Vec3(place[0], place[1], place[2]) / 1000);
    }
    line_.accept(",");
  }
  if (!line_.failed() && (frame.in_frame.size() < 3 || frame.in_frame.size() > kMost)) {
    line_.error(start, "a frame is found from 3 to 32 points; MATCH P1 AT 12.5 30 0, P2 AT 90 30 0, P3 AT 90 110 0");
  }
}

}  // namespace indurop::robot
