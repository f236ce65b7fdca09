// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/jogging.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kFastest = 0.98 * kReducedSpeed;  // m/s of the tip
constexpr double kFarthestMove = 1;                // m
constexpr double kMostTurn = kPi / 2;
constexpr double kAhead = 8;              // s of tip motion that are planned: more would delay the start
constexpr double kTurning = 0.15;         // part of full speed
constexpr double kShortest = 1.0 / 1024;  // part of the longest distance that is tried
constexpr double kEndless = 2 * kPi;      // rad, of an axis that turns without end

}  // namespace

void Jogging::step(const JogRequest& jog, bool permitted) noexcept {
  own_stop_ = own_stop_ && robot_.states.stopping();
  if (!permitted || !is_free()) {
    enabling_switch_.lapse();
  }
  const bool enabled = enabling_switch_.holds(jog.enabled, jog.beat, robot_.period);
  const auto* const wanted = std::find_if(jog.speed.begin(), jog.speed.end(), [](double v) { return v != 0; });
  const int most = jog.frame == JogFrame::Joint ? robot_.count() : 6;
  const std::optional<Quat> directions = axes_of(jog);
  const bool known = directions.has_value();
  const Quat axes = directions.value_or(Quat::Identity());
  int index = enabled && known && wanted != jog.speed.end() ? static_cast<int>(wanted - jog.speed.begin()) : -1;
  index = index < most && index >= 0 && std::abs(*wanted) <= 100 ? index : -1;
  const double speed = index >= 0 ? *wanted / 100 : 0;
  const bool same = index == index_ && speed == speed_ && jog.frame == frame_ && axes.coeffs() == axes_.coeffs();
  blocked_ = blocked_ && same;
  if (on_ && !same && robot_.states.moving()) {
    on_ = false;
    group_.forget_plans();
    robot_.follower.stop();
    robot_.states.stop();
    own_stop_ = true;
  }
  index_ = index;
  speed_ = speed;
  frame_ = jog.frame;
  axes_ = axes;
  if (index >= 0 && !blocked_ && !group_.is_serving() && robot_.states.is(GroupState::Standby) && plans_.can_plan() &&
      group_.may_move() == ErrorCode::Ok) {
    part_ = 1;
    begin();
  }
}

bool Jogging::is_free() const noexcept {
  const GroupStates& states = robot_.states;
  return states.is(GroupState::Standby) || (states.moving() && on_) || (states.stopping() && own_stop_);
}

// Returns the axes along which the frame leads, as seen from that of poses; nothing if there is no such frame.
std::optional<Quat> Jogging::axes_of(const JogRequest& jog) const noexcept {
  switch (jog.frame) {
    case JogFrame::Joint:
    case JogFrame::Base:
    case JogFrame::Tool:
      return Quat::Identity();
    case JogFrame::World:
      return Quat(robot_.parts.arm.world(robot_.commanded()).turn);
    case JogFrame::Work:
      if (const WorkFrame* const work = work_frame(jog.work.view()); work != nullptr) {
        return work->pose.orientation;
      }
      break;
    case JogFrame::Hand:
      break;
  }
  return std::nullopt;
}

const WorkFrame* Jogging::work_frame(std::string_view name) const noexcept {
  constexpr std::size_t kMaxLength = sizeof(JogRequest::work) - 1;
  const std::vector<WorkFrame>& frames = robot_.parts.book.frames;
  const auto found = std::find_if(frames.begin(), frames.end(), [&](const WorkFrame& frame) {
    return std::string_view(frame.name).substr(0, kMaxLength) == name;
  });
  return found != frames.end() ? &*found : nullptr;
}

void Jogging::begin() noexcept {
  const MoveCommand command = frame_ == JogFrame::Joint ? axis_motion(index_, part_) : tip_motion(index_, part_);
  on_ = true;
  robot_.states.move();
  PlanRequest request{command, nullptr, robot_.commanded(), false};
  request.unreserved = true;
  plans_.ask(request);
}

void Jogging::try_shorter() noexcept {
  part_ /= 2;
  blocked_ = part_ < kShortest;
  if (!blocked_) {
    begin();
  }
}

MoveCommand Jogging::axis_motion(int axis, double part) const noexcept {
  const Axis& a = robot_.parts.arm.axis(axis);
  Joints to = robot_.commanded();
  // An axis beyond its limit may only return.
  const double left = speed_ > 0 ? std::max(a.upper - to[axis], 0.0) : std::min(a.lower - to[axis], 0.0);
  to[axis] += part * (a.endless ? std::copysign(kEndless, speed_) : left);
  // While only this axis moves, the distance that the tip moves per unit of the axis is constant, unless the axis
  // slides.
  const double arm = robot_.tool.arm().jacobian(robot_.commanded()).block<3, 1>(0, axis).norm();
  MoveCommand command;
  command.straight = true;
  command.target.joints = to;
  const double fastest = robot_.parts.joints.velocity[axis];
  command.speed = std::min(1.0, kFastest / std::max(arm * fastest, 1e-9)) * std::abs(speed_);
  return command;
}

MoveCommand Jogging::tip_motion(int direction, double part) const noexcept {
  const Pose now = robot_.tool.arm().forward(robot_.commanded());
  const bool turns = direction >= 3;
  const double speed = std::abs(speed_) * (turns ? kTurning * robot_.parts.tool.turn_velocity : kFastest);
  Vec3 way = Vec3::Zero();
  way[direction % 3] = std::copysign(part * std::min(turns ? kMostTurn : kFarthestMove, kAhead * speed), speed_);
  MoveCommand command;
  command.move = Move::Line;
  command.target.is_pose = true;
  command.target.pose = now;
  Pose& to = command.target.pose;
  const bool by_tool = frame_ == JogFrame::Tool;
  if (turns) {
    to.orientation = by_tool ? now.orientation * rotation_by(way) : rotation_by(axes_ * way) * now.orientation;
    command.speed = kTurning * std::abs(speed_);
  } else {
    to.position += by_tool ? now.orientation * way : axes_ * way;
    command.tool_speed = kFastest * std::abs(speed_);
  }
  return command;
}

}  // namespace indurop::robot
