// SPDX-License-Identifier: Apache-2.0
// Jogging: a straight motion of one axis, or of the tip, as long as possible, which ends when it is no longer
// requested. So it keeps all limits like any other motion, and the tip is never faster than 250 mm/s (ISO 10218-1).

#include <algorithm>
#include <cmath>
#include <string_view>

#include "control/robot/group/group.h"

namespace indurop::robot {

namespace {

constexpr double kFastest = 0.98 * kReducedSpeed;  // m/s of the tip
constexpr double kFarthest = 1;                    // m
constexpr double kMostTurned = kPi / 2;
constexpr double kAhead = 8;              // s of tip motion that are planned: more would delay the start
constexpr double kTurning = 0.15;         // part of full speed
constexpr double kShortest = 1.0 / 1024;  // part of the longest distance that is tried
constexpr double kEndless = 2 * kPi;      // rad, of an axis that turns without end

}  // namespace

void Group::serve_jog(const JogRequest& jog) noexcept {
  const bool enabled =
      dead_man_.holds(jog.enabled, jog.beat, period_) && permit_ == ErrorCode::Ok && mode_ != OperatingMode::Automatic;
  const auto* const wanted = std::find_if(jog.speed.begin(), jog.speed.end(), [](double v) { return v != 0; });
  const int most = jog.frame == JogFrame::Joint ? count() : 6;
  const WorkFrame* const work = jog.frame == JogFrame::Work ? work_frame(jog.work.view()) : nullptr;
  const bool known = jog.frame >= JogFrame::Joint && (jog.frame < JogFrame::Work || work != nullptr);
  const Quat axes = work != nullptr ? work->pose.orientation : Quat::Identity();
  int index = enabled && known && wanted != jog.speed.end() ? static_cast<int>(wanted - jog.speed.begin()) : -1;
  index = index < most && index >= 0 && std::abs(*wanted) <= 100 ? index : -1;
  const double speed = index >= 0 ? *wanted / 100 : 0;
  const bool same =
      index == jog_index_ && speed == jog_speed_ && jog.frame == jog_frame_ && axes.coeffs() == jog_axes_.coeffs();
  jog_blocked_ = jog_blocked_ && same;
  if (jogging_ && !same && state_ == GroupState::Moving) {
    jogging_ = false;
    forget_plans();
    follower_.stop();
    state_ = GroupState::Stopping;
  }
  jog_index_ = index;
  jog_speed_ = speed;
  jog_frame_ = jog.frame;
  jog_axes_ = axes;
  if (index >= 0 && !jog_blocked_ && !active_ && state_ == GroupState::Standby && can_plan() &&
      may_move() == ErrorCode::Ok) {
    jog_part_ = 1;
    begin_jog();
  }
}

const WorkFrame* Group::work_frame(std::string_view name) const noexcept {
  constexpr std::size_t kMost = sizeof(JogRequest::work) - 1;
  const std::vector<WorkFrame>& frames = parts_.book.frames;
  const auto found = std::find_if(frames.begin(), frames.end(), [&](const WorkFrame& frame) {
    return std::string_view(frame.name).substr(0, kMost) == name;
  });
  return found != frames.end() ? &*found : nullptr;
}

void Group::begin_jog() noexcept {
  const MoveCommand command =
      jog_frame_ == JogFrame::Joint ? jog_axis(jog_index_, jog_part_) : jog_tip(jog_index_, jog_part_);
  jogging_ = true;
  state_ = GroupState::Moving;
  ask_for_plan({command, nullptr, commanded(), false});
}

// Tries a shorter distance; after some attempts jogging counts as blocked.
void Group::jog_shorter() noexcept {
  jog_part_ /= 2;
  jog_blocked_ = jog_part_ < kShortest;
  if (!jog_blocked_) {
    begin_jog();
  }
}

MoveCommand Group::jog_axis(int axis, double part) const noexcept {
  const Axis& a = parts_.arm.axis(axis);
  Joints to = commanded();
  // An axis beyond its limit may only return.
  const double left = jog_speed_ > 0 ? std::max(a.upper - to[axis], 0.0) : std::min(a.lower - to[axis], 0.0);
  to[axis] += part * (a.endless ? std::copysign(kEndless, jog_speed_) : left);
  // While only this axis moves, the distance that the tip moves per unit of the axis is constant, unless the axis
  // slides.
  const double arm = places_.arm().jacobian(commanded()).block<3, 1>(0, axis).norm();
  MoveCommand command;
  command.straight = true;
  command.target.joints = to;
  const double fastest = parts_.joints.velocity[axis];
  command.speed = std::min(1.0, kFastest / std::max(arm * fastest, 1e-9)) * std::abs(jog_speed_);
  return command;
}

MoveCommand Group::jog_tip(int direction, double part) const noexcept {
  const Pose now = places_.arm().forward(commanded());
  const bool turns = direction >= 3;
  const double speed = std::abs(jog_speed_) * (turns ? kTurning * parts_.tool.turn_velocity : kFastest);
  Vec3 way = Vec3::Zero();
  way[direction % 3] = std::copysign(part * std::min(turns ? kMostTurned : kFarthest, kAhead * speed), jog_speed_);
  MoveCommand command;
  command.move = Move::Line;
  command.target.is_pose = true;
  command.target.pose = now;
  Pose& to = command.target.pose;
  const bool by_tool = jog_frame_ == JogFrame::Tool;
  if (turns) {
    to.orientation = by_tool ? now.orientation * rotation_by(way) : rotation_by(jog_axes_ * way) * now.orientation;
    command.speed = kTurning * std::abs(jog_speed_);
  } else {
    to.position += by_tool ? now.orientation * way : jog_axes_ * way;
    command.tool_speed = kFastest * std::abs(jog_speed_);
  }
  return command;
}

}  // namespace indurop::robot
