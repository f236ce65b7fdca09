// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/point_lines.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace indurop::robot {
namespace {

// Offset at which a line's comment begins, including the spaces before it; the end of the line if there is none.
std::size_t comment_of(std::string_view line) {
  std::size_t at = std::min(line.find('#'), line.find("//"));
  at = std::min(at, line.size());
  while (at > 0 && (line[at - 1] == ' ' || line[at - 1] == '\t' || line[at - 1] == '\r')) {
    --at;
  }
  return at;
}

// A line of the text, from 1.
std::string_view line_in(std::string_view text, int line) {
  std::size_t begin = 0;
  for (int at = 1; at < line && begin < text.size(); ++at) {
    begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  }
  return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
}

}  // namespace

std::string decimal_text(double value, int decimals) {
  const double parts = std::pow(10, decimals);
  const double rounded = std::round(value * parts) / parts;
  std::array<char, 64> text{};
  const auto [end, error] =
      std::to_chars(text.data(), text.data() + text.size(), rounded == 0 ? 0.0 : rounded, std::chars_format::fixed);
  return error == std::errc{} ? std::string(text.data(), end) : "?";
}

Joints joints_of_values(const Arm& arm, std::span<const double> values) {
  Joints joints = Joints::Zero();
  for (int i = 0; i < arm.count(); ++i) {
    const double value = values[static_cast<std::size_t>(i)];
    joints[i] = arm.axis(i).slides() ? value / 1000 : radians(value);
  }
  return joints;
}

std::string joint_text(const Arm& arm, const Joints& joints) {
  std::string out = "JOINT";
  for (int i = 0; i < arm.count(); ++i) {
    out += ' ' + decimal_text(arm.axis(i).slides() ? joints[i] * 1000 : degrees(joints[i]));
  }
  return out;
}

std::string pose_text(const Pose& pose) {
  const Vec3 turn = to_rpy(pose.orientation).unaryExpr([](double a) { return degrees(a); });
  const Vec3 place = pose.position * 1000;
  return "POSE " + decimal_text(place.x()) + ' ' + decimal_text(place.y()) + ' ' + decimal_text(place.z()) + " RPY " +
         decimal_text(turn.x()) + ' ' + decimal_text(turn.y()) + ' ' + decimal_text(turn.z());
}

std::string pose_text(const Arm& arm, const Target& target, const WorkFrame* frame) {
  std::string out = pose_text(frame == nullptr ? target.pose : seen_from(frame->pose, target.pose));
  out += target.posture ? " POSTURE " + std::to_string(*target.posture) : "";
  for (int i = 0; i < arm.count(); ++i) {
    if (holds(target.held, i)) {
      const double at = target.joints[i];
      out += " AXIS " + std::to_string(i + 1) + ' ' + decimal_text(arm.axis(i).slides() ? at * 1000 : degrees(at));
    }
  }
  return out + (frame == nullptr ? "" : " IN " + frame->name);
}

std::string place_text(const JobBook& book, const Point& point, const Arm& arm) {
  if (!point.target.is_pose) {
    return joint_text(arm, point.target.joints);
  }
  return pose_text(arm, point.target, point.frame < 0 ? nullptr : &book.frames[static_cast<std::size_t>(point.frame)]);
}

Pose seen_from(const Pose& frame, const Pose& pose) {
  const Quat back = frame.orientation.conjugate();
  return {back * (pose.position - frame.position), back * pose.orientation};
}

WithPoint put_point(std::string_view text, int line, std::string_view name, std::string_view place) {
  std::string statement = "POINT ";
  statement.append(name).append(" = ").append(place);
  return put_statement(text, line, statement);
}

std::string_view statement_in(std::string_view text, int line) {
  const std::string_view whole = line_in(text, line);
  const std::size_t indented = std::min(whole.find_first_not_of(" \t"), whole.size());
  return whole.substr(indented, std::max(comment_of(whole), indented) - indented);
}

WithPoint put_statement(std::string_view text, int line, std::string_view statement) {
  if (line == 0) {
    WithPoint out{std::string(text), 0};
    out.text += !text.empty() && text.back() != '\n' ? "\n" : "";
    out.text.append(statement) += '\n';
    out.line = static_cast<int>(std::count(out.text.begin(), out.text.end(), '\n'));
    return out;
  }
  const std::string_view old = statement_in(text, line);
  const auto begin = static_cast<std::size_t>(old.data() - text.data());
  std::string out(text.substr(0, begin));
  out += statement;
  out += text.substr(begin + old.size());
  return {std::move(out), line};
}

}  // namespace indurop::robot
