// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/motion_report.h"

namespace indurop::robot {

namespace {

void put(const Vec3& metres, const Vec3& angle, std::array<double, 6>& to) noexcept {
  for (int i = 0; i < 3; ++i) {
    to[at(i)] = 1000 * metres[i];
    to[at(i + 3)] = degrees(angle[i]);
  }
}

}  // namespace

void MotionReport::report(bool commanded, Outputs& out) noexcept {
  ranges_.step();
  const Joints now = robot_.commanded();
  const Pose pose = robot_.tip(now);
  if (tool_changes_ != robot_.tool.changes()) {
    tool_changes_ = robot_.tool.changes();
    last_ = robot_.tip(robot_.axes.last());
  }
  if (!commanded) {  // drives have only just reported their positions, or the arm is moved by hand
    last_ = pose;
    robot_.axes.start_here();
  }
  const Twist moved = difference(last_, pose) / robot_.period;
  report_axes(out);
  const Vec3 rpy = to_rpy(pose.orientation);
  for (int i = 0; i < 3; ++i) {
    out.position[at(i)] = 1000 * pose.position[i];
    out.orientation[at(i)] = degrees(rpy[i]);
    out.velocity[at(i)] = 1000 * moved[i];
    out.turning[at(i)] = degrees(moved[i + 3]);
  }
  report_tool(moved, out);
  out.tool_speed = 1000 * moved.head<3>().norm();
  out.path_speed = 100 * robot_.follower.speed();
  out.to_go = robot_.follower.to_go();
  last_ = pose;
  robot_.axes.note((now - robot_.axes.last()) / robot_.period);
}

void MotionReport::report_axes(Outputs& out) const noexcept {
  for (int i = 0; i < robot_.count(); ++i) {
    const AxisControl& a = robot_.axes[i];
    out.joints[at(i)] = a.measured() / a.unit();
    out.command[at(i)] = a.commanded().position / a.unit();
    out.speed[at(i)] = a.commanded().velocity / a.unit();
    out.acceleration[at(i)] = a.commanded().acceleration / a.unit();
  }
}

void MotionReport::report_tool(const Twist& moved, Outputs& out) noexcept {
  const Pose tool = robot_.tip(robot_.axes.measured());
  const Twist change = (moved - last_moved_) / robot_.period;
  last_moved_ = moved;
  const auto fill = [&](const Pose& pose, const Quat& turn, ToolReport& report) {
    put(pose.position, to_rpy(pose.orientation), report.position);
    put(turn * moved.head<3>(), turn * moved.tail<3>(), report.velocity);
    put(turn * change.head<3>(), turn * change.tail<3>(), report.acceleration);
  };
  const Pose& product = conveyor_.product();
  const Quat back = product.orientation.conjugate();
  fill(tool, Quat::Identity(), out.machine);
  fill({back * (tool.position - product.position), back * tool.orientation}, back, out.product);
  out.product_frame = conveyor_.product_given();
}

}  // namespace indurop::robot
