// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/resuming.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace indurop::robot {

namespace {

constexpr double kSlowly = 0.1;           // part of full speed, on the way back to the path
constexpr double kTipSlowly = 0.1;        // m/s, of the tip
constexpr double kFarthestTurned = 0.79;  // rad that a joint may be away: farther, it may be another posture
constexpr double kSameJoints = 1e-9;      // rad

}  // namespace

void Resuming::set_aside() noexcept {
  set_aside(robot_.tool.number(), !plans_.free());
  robot_.follower.keep_path();
}

void Resuming::set_aside(int tool, bool asked) noexcept {
  aside_ = true;
  aside_tool_ = tool;
  asked_ = asked;
}

void Resuming::drop() noexcept {
  aside_ = false;
  passed_known_ = 0;
  correction_.end();
}

void Resuming::pause() noexcept {
  set_aside(robot_.tool.number(), false);
  robot_.follower.keep_path();
  group_.come_to_standby();
  group_.finish_service(ErrorCode::Ok);
}

// Speed of a straight joint motion to `to`, from the mean speed of the tip.
double Resuming::speed_to(const Joints& to) const noexcept {
  constexpr int kParts = 16;
  const Joints from = robot_.commanded();
  double way = 0;
  Vec3 before = robot_.tip(from).position;
  for (int i = 1; i <= kParts; ++i) {
    const Vec3 place = robot_.tip(from + (to - from) * i / kParts).position;
    way += (place - before).norm();
    before = place;
  }
  double seconds = 0;
  for (int i = 0; i < robot_.count(); ++i) {
    seconds = std::max(seconds, std::abs(to[i] - from[i]) / robot_.parts.joints.velocity[i]);
  }
  return way > 0 ? std::min(kSlowly, kTipSlowly * seconds / way) : kSlowly;
}

void Resuming::say_how_far(const Joints& to) noexcept {
  const Joints off = (to - robot_.commanded()).head(kAxes);
  const double away = 1000 * (robot_.tip(to).position - robot_.tip(robot_.commanded()).position).norm();
  Eigen::Index axis = 0;
  const double turned = off.head(robot_.count()).cwiseAbs().maxCoeff(&axis);
  char text[120];
  std::snprintf(
      text, sizeof text,
      "the robot is %.0f mm (axis %d: %.0f deg) from where its job left the path; %.0f mm (%.0f deg) is the most", away,
      static_cast<int>(axis) + 1, degrees(turned), robot_.parts.settings.regain_distance, degrees(kFarthestTurned));
  robot_.job.set_message(text);
}

ErrorCode Resuming::resume() noexcept {
  if (!aside_) {
    if (robot_.states.press_stopped()) {
      robot_.job.set_message("a RobotPress that was stopped cannot be resumed: set its Execute to FALSE, then to TRUE");
    }
    return ErrorCode::NoResume;
  }
  if (const ErrorCode code = group_.may_move(); code != ErrorCode::Ok || !robot_.states.is(GroupState::Standby)) {
    return code == ErrorCode::Ok ? ErrorCode::State : code;
  }
  if (!group_.change_tool(aside_tool_)) {
    return ErrorCode::State;
  }
  Joints to = robot_.follower.kept_path().q;
  if (!correction_.shift_kept(to)) {
    return ErrorCode::Unreachable;
  }
  if (!is_near(to)) {
    say_how_far(to);
    return ErrorCode::Away;
  }
  return_ = Return::ToPath;
  robot_.states.move(true);
  ask_for_way_back(to);
  return ErrorCode::Ok;
}

bool Resuming::is_near(const Joints& place) const noexcept {
  const double away = 1000 * (robot_.tip(place).position - robot_.tip(robot_.commanded()).position).norm();
  return away <= robot_.parts.settings.regain_distance &&
         (place - robot_.commanded()).head(robot_.count()).cwiseAbs().maxCoeff() <= kFarthestTurned;
}

// Requests no motion if the robot is already there. Next to a positioner, it would be no line on the workpiece if it
// were one of the joints.
void Resuming::ask_for_way_back(const Joints& to) noexcept {
  back_to_ = to;
  on_workpiece_ = robot_.parts.arm.world_joint() > 0;
  if ((to - robot_.commanded()).head(robot_.count()).cwiseAbs().maxCoeff() <= kSameJoints) {
    return;
  }
  if (!on_workpiece_) {
    ask_in_joint_space();
    return;
  }
  MoveCommand back;
  back.move = Move::Line;
  back.exact = true;
  back.target.is_pose = true;
  back.target.pose = robot_.tip(to);
  back.target.held = robot_.tool.inverse().held();
  back.speed = std::min(kSlowly, kTipSlowly / robot_.parts.tool.velocity);
  ask(back);
}

void Resuming::ask_in_joint_space() noexcept {
  MoveCommand back;
  back.straight = true;
  back.speed = speed_to(back_to_);
  ask(back);
}

// The last request is that of the job, which it may have to make again.
void Resuming::ask(MoveCommand back) noexcept {
  const PlanRequest before = plans_.request();
  back.target.joints = back_to_;
  plans_.ask({back, nullptr, robot_.commanded(), false});
  plans_.set_request(before);
}

bool Resuming::try_joints() noexcept {
  if ((return_ != Return::ToPath && return_ != Return::FromInterrupt) || !on_workpiece_) {
    return false;
  }
  on_workpiece_ = false;
  ask_in_joint_space();
  return true;
}

void Resuming::begin_from_interrupt(const Joints& to) noexcept {
  return_ = Return::FromInterrupt;
  ask_for_way_back(to);
}

ErrorCode Resuming::step_back() noexcept {
  if (!aside_ || passed_known_ == 0) {
    return ErrorCode::NoResume;
  }
  const bool between = !robot_.follower.kept_path().known() && !asked_ && plans_.ahead().empty();
  const Joints off = robot_.follower.kept_path().q - robot_.commanded();
  const bool there = off.head(robot_.count()).cwiseAbs().maxCoeff() <= kSameJoints;
  if (const ErrorCode code = group_.may_move(); code != ErrorCode::Ok) {
    return code;
  }
  if (!robot_.states.is(GroupState::Standby) || !between || !there || !group_.change_tool(aside_tool_)) {
    return ErrorCode::State;
  }
  const Passed& last = passed_[(passed_count_ - 1) % passed_.size()];
  if (!robot_.job.is_in(last.command.source)) {
    return ErrorCode::State;
  }
  MoveCommand back = last.command;
  back.target = last.from;
  back.target.held = last.from.is_pose ? 0 : robot_.tool.inverse().held();  // the elbow goes back, too
  back.zone = 0;
  back.source = 0;
  return_ = Return::Back;
  robot_.states.move();
  plans_.ask({back, nullptr, robot_.commanded(), false});
  return ErrorCode::Ok;
}

void Resuming::end_way_back() noexcept {
  const bool back = return_ == Return::Back;
  return_ = Return::None;
  if (back) {
    --passed_known_;
    robot_.job.go_back(passed_[--passed_count_ % passed_.size()].command.source);
    pause();
    return;
  }
  aside_ = false;
  correction_.resume();
  robot_.job.resume();
  continue_on_path(asked_);
}

bool Resuming::may_continue(const KeptPath& path) noexcept {
  SharedSpace& space = plans_.space();
  const SharedSpace::Answer answer = space.request(path.pieces);
  if (answer == SharedSpace::Answer::Deadlock || answer == SharedSpace::Answer::Mismatch) {
    group_.trip(ErrorCode::OtherRobot, 0, 1, space.text());
  }
  return answer == SharedSpace::Answer::Granted;
}

void Resuming::continue_on_path(bool asked) noexcept {
  plans_.disconnect();
  robot_.follower.resume();
  robot_.axes.start_here();
  asked_ = false;
  if (asked) {
    plans_.ask_again();
  }
}

void Resuming::note(const Passed& passed) noexcept {
  passed_[passed_count_++ % passed_.size()] = passed;
  passed_known_ = passed.command.source < 0 ? 0 : std::min(passed_known_ + 1, passed_.size());
}

void Resuming::note(const MoveCommand& command, const Joints& from) noexcept {
  Passed passed{command, {}};
  passed.from.joints = from;
  note(passed);
}

void Resuming::note(const Chain& lines, double acceleration, const Joints& from) noexcept {
  Passed passed;
  passed.from.joints = from;
  for (int i = 0; i < lines.count(); ++i) {
    passed.command = lines.line(i);
    passed.command.acceleration = acceleration;
    note(passed);
    passed.from = passed.command.target;
  }
}

}  // namespace indurop::robot
