// SPDX-License-Identifier: Apache-2.0
// What the group says about itself in every period.

#include "robot/group.h"

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
  out.tool = static_cast<std::uint32_t>(tool_);
  out.tool_name = parts_.book.tools[static_cast<std::size_t>(tool_)].name.c_str();
  out.job = job_.report(follower_.source());
  out.job.can_resume = aside_ && state_ != GroupState::Moving;
  for (std::size_t i = 0; i < kJoints; ++i) {
    out.axes[i] = axes_[i].report();
  }
  report_motion(out);
}

void Group::report_motion(Outputs& out) noexcept {
  const Joints now = commanded();
  const Pose pose = places_.arm().forward(now);
  const Twist moved = difference(last_pose_, pose) / period_;
  last_speed_ = (now - last_command_) / period_;
  for (int i = 0; i < count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double unit = axes_[k].unit();
    out.joints[k] = axes_[k].measured() / unit;
    out.command[k] = now[i] / unit;
    out.speed[k] = axes_[k].commanded().velocity / unit;
  }
  const Vec3 rpy = to_rpy(pose.orientation);
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    out.position[k] = 1000 * pose.position[i];
    out.orientation[k] = degrees(rpy[i]);
    out.velocity[k] = 1000 * moved[i];
    out.turning[k] = degrees(moved[i + 3]);
  }
  out.tool_speed = 1000 * moved.head<3>().norm();
  out.path_speed = 100 * follower_.speed();
  out.to_go = follower_.to_go();
  last_pose_ = pose;
  last_command_ = now;
}

}  // namespace indurop::robot
