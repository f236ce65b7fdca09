// SPDX-License-Identifier: Apache-2.0
// The status that the group reports in every period.

#include <algorithm>

#include "control/robot/group/group.h"

namespace indurop::robot {

void Group::report(Outputs& out) noexcept {
  out.state = state_;
  out.busy = active_ || state_ == GroupState::Moving || state_ == GroupState::Homing || state_ == GroupState::Stopping;
  out.motion_done = motion_done_ && !active_;
  out.edit_done = edit_done_;
  out.moving_by_job = job_moves_ && state_ == GroupState::Moving;
  out.acknowledged = acknowledged_;
  out.done = done_;
  out.error = error_;
  out.error_axis = static_cast<std::uint32_t>(error_axis_);
  out.mode = mode_;
  out.may_move = permit_ == ErrorCode::Ok;
  out.tool = static_cast<std::uint32_t>(tool_);
  out.tool_name = parts_.book.tools[static_cast<std::size_t>(tool_)].name.c_str();
  out.job = job_.report(follower_.source());
  if (pace_wrong_) {
    out.job.message = "ROBOT_OVERRIDE or MC_FACTORS is below 0 or no number, so the robot holds: correct it";
  }
  out.job.can_resume = aside_ && state_ != GroupState::Moving;
  for (std::size_t i = 0; i < kJoints; ++i) {
    out.axes[i] = axes_[i].report();
    out.axes[i].torque = torque_[static_cast<int>(i)];
    out.axes[i].push = contact_.residual()[static_cast<int>(i)];
  }
  out.commands = table_.answers();
  report_break_down(out);
  report_product();
  report_motion(out);
}

bool Group::commands_motion() const noexcept {
  return state_ != GroupState::Disabled || enabling_ ||
         std::any_of(axes().begin(), axes().end(), [](const AxisControl& a) { return a.wants_power(); });
}

void Group::report_motion(Outputs& out) noexcept {
  const Joints now = commanded();
  const Pose pose = places_.arm().forward(now);
  if (!commands_motion()) {  // drives have only just reported their positions, or the arm is moved by hand
    last_pose_ = pose;
    last_command_ = now;
  }
  const Twist moved = difference(last_pose_, pose) / period_;
  last_speed_ = (now - last_command_) / period_;
  for (int i = 0; i < count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double unit = axes_[k].unit();
    out.joints[k] = axes_[k].measured() / unit;
    out.command[k] = now[i] / unit;
    out.speed[k] = axes_[k].commanded().velocity / unit;
    out.acceleration[k] = axes_[k].commanded().acceleration / unit;
  }
  const Vec3 rpy = to_rpy(pose.orientation);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.position[k] = 1000 * pose.position[i];
    out.orientation[k] = degrees(rpy[i]);
    out.velocity[k] = 1000 * moved[i];
    out.turning[k] = degrees(moved[i + 3]);
  }
  report_tool(moved, out);
  out.tool_speed = 1000 * moved.head<3>().norm();
  out.path_speed = 100 * follower_.speed();
  out.to_go = follower_.to_go();
  last_pose_ = pose;
  last_command_ = now;
}

void Group::report_tool(const Twist& moved, Outputs& out) noexcept {
  Joints measured = Joints::Zero();
  for (int i = 0; i < count(); ++i) {
    measured[i] = axes_[static_cast<std::size_t>(i)].measured();
  }
  const Pose tool = places_.arm().forward(measured);
  const Twist change = (moved - last_moved_) / period_;
  last_moved_ = moved;
  const auto tell = [&](const Pose& pose, const Quat& turn, ToolReport& report) {
    const Vec3 rpy = to_rpy(pose.orientation);
    const auto put = [](const Vec3& metres, const Vec3& angle, std::array<double, 6>& to) {
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        to[k] = 1000 * metres[i];
        to[k + 3] = degrees(angle[i]);
      }
    };
    put(pose.position, rpy, report.position);
    put(turn * moved.head<3>(), turn * moved.tail<3>(), report.velocity);
    put(turn * change.head<3>(), turn * change.tail<3>(), report.acceleration);
  };
  const Quat back = product_.orientation.conjugate();
  tell(tool, Quat::Identity(), out.machine);
  tell({back * (tool.position - product_.position), back * tool.orientation}, back, out.product);
  out.product_frame = product_given_;
}

}  // namespace indurop::robot
