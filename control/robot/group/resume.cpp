// SPDX-License-Identifier: Apache-2.0
// Continues jobs that a stop, an error or a pause interrupted: slowly back to the path, then on. Also single steps
// back.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "control/robot/group/group.h"

namespace indurop::robot {

namespace {

constexpr double kSlowly = 0.1;       // part of full speed, on the way back to the path
constexpr double kTipSlowly = 0.1;    // m/s, of the tip
constexpr double kMostTurned = 0.79;  // rad that a joint may be away: farther, it may be another posture
constexpr double kThere = 1e-9;       // rad

}  // namespace

void Group::set_job_aside() noexcept {
  if (!job_.running() || set_shelf_aside()) {
    return;
  }
  aside_ = true;
  aside_tool_ = tool_;
  request_aside_ = !desk_.free();
  follower_.set_aside();
}

void Group::drop_aside() noexcept {
  aside_ = false;
  passed_known_ = 0;
  ahead_.clear();
  shelf_->used = shelf_->leaving = false;
  shelf_->ahead.clear();
}

// Pauses the job: the robot is at standstill, and no motion of the job is in progress.
void Group::pause_job() noexcept {
  aside_ = true;
  aside_tool_ = tool_;
  request_aside_ = false;
  follower_.set_aside();
  come_to_standby();
  finish_service(ErrorCode::Ok);
}

// Speed of a straight joint motion to `to`, from the mean speed of the tip.
double Group::speed_back(const Joints& to) const noexcept {
  constexpr int kParts = 16;
  const Joints from = commanded();
  double way = 0;
  Vec3 before = places_.arm().forward(from).position;
  for (int i = 1; i <= kParts; ++i) {
    const Vec3 place = places_.arm().forward(from + (to - from) * i / kParts).position;
    way += (place - before).norm();
    before = place;
  }
  double seconds = 0;
  for (int i = 0; i < count(); ++i) {
    seconds = std::max(seconds, std::abs(to[i] - from[i]) / parts_.joints.velocity[i]);
  }
  return way > 0 ? std::min(kSlowly, kTipSlowly * seconds / way) : kSlowly;
}

ErrorCode Group::resume_job() noexcept {
  if (!aside_) {
    return ErrorCode::NoResume;
  }
  if (const ErrorCode code = may_move(); code != ErrorCode::Ok || state_ != GroupState::Standby) {
    return code == ErrorCode::Ok ? ErrorCode::State : code;
  }
  if (!take_tool(aside_tool_)) {
    return ErrorCode::State;
  }
  const Joints to = follower_.aside();
  if (!is_near(to)) {
    const Joints off = (to - commanded()).head(kAxes);
    const double away =
        1000 * (places_.arm().forward(to).position - places_.arm().forward(commanded()).position).norm();
    Eigen::Index axis = 0;
    const double turned = off.head(count()).cwiseAbs().maxCoeff(&axis);
    char text[120];
    std::snprintf(
        text, sizeof text,
        "the robot is %.0f mm (axis %d: %.0f deg) from where its job left the path; %.0f mm (%.0f deg) is the most",
        away, static_cast<int>(axis) + 1, degrees(turned), parts_.settings.regain_distance, degrees(kMostTurned));
    job_.say(text);
    return ErrorCode::Away;
  }
  return_ = Return::ToPath;
  state_ = GroupState::Moving;
  job_moves_ = true;
  const PlanRequest before = request_;
  ask_for_way_back(to);
  request_ = before;
  return ErrorCode::Ok;
}

bool Group::is_near(const Joints& place) const noexcept {
  const double away =
      1000 * (places_.arm().forward(place).position - places_.arm().forward(commanded()).position).norm();
  return away <= parts_.settings.regain_distance &&
         (place - commanded()).head(count()).cwiseAbs().maxCoeff() <= kMostTurned;
}

// Requests no motion if the robot is already there.
void Group::ask_for_way_back(const Joints& to) noexcept {
  if ((to - commanded()).head(count()).cwiseAbs().maxCoeff() > kThere) {
    MoveCommand back;
    back.straight = true;
    back.target.joints = to;
    back.speed = speed_back(to);
    ask_for_plan({back, nullptr, commanded(), false});
  }
}

// Goes back one motion, in a job that pauses between two motions.
ErrorCode Group::back_job() noexcept {
  if (!aside_ || passed_known_ == 0) {
    return ErrorCode::NoResume;
  }
  const bool between = !follower_.has_path_aside() && !request_aside_ && ahead_.empty();
  const bool there = (follower_.aside() - commanded()).head(count()).cwiseAbs().maxCoeff() <= kThere;
  if (const ErrorCode code = may_move(); code != ErrorCode::Ok) {
    return code;
  }
  if (state_ != GroupState::Standby || !between || !there || !take_tool(aside_tool_)) {
    return ErrorCode::State;
  }
  const Passed& last = passed_[(passed_count_ - 1) % passed_.size()];
  if (!job_.is_in(last.command.source)) {
    return ErrorCode::State;
  }
  MoveCommand back = last.command;
  back.target = {};
  back.target.joints = last.from;
  back.zone = 0;
  back.source = 0;
  return_ = Return::Back;
  state_ = GroupState::Moving;
  ask_for_plan({back, nullptr, commanded(), false});
  return ErrorCode::Ok;
}

// The robot is where the job left its path, or one motion further back.
void Group::end_return() noexcept {
  if (return_ == Return::FromInterrupt) {
    end_come_back();
    return;
  }
  const bool back = return_ == Return::Back;
  return_ = Return::None;
  if (back) {
    --passed_known_;
    job_.go_back(passed_[--passed_count_ % passed_.size()].command.source);
    pause_job();
    return;
  }
  aside_ = false;
  unconnected_ = true;
  follower_.go_on();
  last_command_ = commanded();
  job_.resume();
  if (request_aside_) {
    request_.follows = false;
    request_aside_ = false;
    ask_for_plan(request_);
  }
}

}  // namespace indurop::robot
