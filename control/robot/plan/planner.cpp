// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/planner.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr int kFewestPlaces = 24;      // places
constexpr double kJump = radians(60);  // between neighbouring places: the arm would have to flip over
constexpr double kSlowest = 1e-9;      // m/s, and parts of full speed: below it counts as no motion

ErrorCode code_of(Reach reach) noexcept {
  switch (reach) {
    case Reach::Ok:
      return ErrorCode::Ok;
    case Reach::OutOfReach:
      return ErrorCode::Unreachable;
    case Reach::JointLimit:
      return ErrorCode::JointLimit;
  }
  return ErrorCode::Unreachable;
}

// An arm with few axes may not reach the orientation: compares it with the one that it reaches.
bool misses_orientation(const Arm& arm, const Pose& pose, const Joints& q) noexcept {
  constexpr double kTurned = 2e-3;  // rad
  return arm.count() < 6 && rotation_between(arm.forward(q).orientation, pose.orientation).norm() > kTurned;
}

bool finite(const Target& target) noexcept {
  return target.joints.allFinite() && target.pose.position.allFinite() && target.pose.orientation.coeffs().allFinite();
}

}  // namespace

Planner::Planner(const Places& places, const JointLimits& joints, const ToolLimits& tool)
    : places_(places),
      all_joints_(joints),
      all_tool_(tool),
      joints_(joints),
      tool_(tool),
      way_(places.box(), Vec3::Zero()),
      clear_(places.clearance(), true),
      search_(places_, joints_),
      rehearsal_(places_, joints_),
      effort_(places_, all_joints_) {
  for (int i = 1; i <= 256; ++i) {
    usual_volume_ = std::max(usual_volume_, std::abs(volume(places.arm().spread(i))));
  }
}

Fault Planner::resolve(const MoveCommand& command, const Joints& near, Joints& joints, Pose& pose) noexcept {
  const Target& target = command.target;
  if (!finite(target)) {
    return {ErrorCode::Value};
  }
  if (!target.is_pose) {
    joints = target.joints;
    pose = places_.arm().forward(joints);
    const int beyond = places_.arm().beyond_limits(joints);
    return {beyond < 0 ? ErrorCode::Ok : ErrorCode::JointLimit, beyond + 1};
  }
  pose = target.pose;
  if (command.move != Move::Joint && !places_.inverse().closed_form()) {
    return {};  // a path that is followed from place to place reaches its end anyway
  }
  const Inverse& inverse = places_.inverse();
  const auto found = target.known != nullptr ? inverse.nearest(*target.known, near, target.posture)
                     : inverse.closed_form() ? inverse.nearest(pose, near, target.posture)
                                             : search(target, near);
  joints = found.solution.q;
  return {code_of(found.reach)};
}

// Searches for an arm without a closed form if no solutions are known: next to a point, or for a pose given by a
// command. An axis that the pose leaves undetermined stays where it is, if possible.
Inverse::Result Planner::search(const Target& target, const Joints& near) noexcept {
  const Inverse& inverse = places_.inverse();
  Search how{32, 96};
  how.held = target.held != 0 ? target.held : redundant_axes(places_.arm());
  const Joints& from = target.held != 0 ? target.joints : near;
  Solutions found = inverse.search(target.pose, from, how);
  work_ += how.most;
  if (found.count == 0 && target.held == 0 && how.held != 0) {
    how.held = 0;
    found = inverse.search(target.pose, from, how);
    work_ += how.most;
  }
  if (found.count == 0) {
    return {found.reach, {}};
  }
  return inverse.nearest(found, near, target.posture);
}

void Planner::begin(const Joints& from, double acceleration) noexcept {
  segment_ = {};
  segment_.acceleration = acceleration;
  joints_ = gentler(all_joints_, acceleration);
  tool_ = gentler(all_tool_, acceleration);
  segment_.from = from;
  segment_.start = places_.arm().forward(from);
  count_ = 0;
  next_ = 1;
  windows_ = noted_ = rehearsals_ = 0;
  narrow_.fill({0, from});
  slowest_ = HUGE_VAL;
  stretches_ = 0;
  unseen_ = false;
  work_ = 0;
  weight_ = places_.inverse().closed_form() ? 1 : kStepByStep;
  searches_ = 1;
  stage_ = Stage::Done;
}

Fault Planner::begin(const MoveCommand& command, const Joints& from) noexcept {
  begin(from, command.acceleration);
  segment_.move = command.move;
  segment_.zone = command.zone;
  segment_.source = command.source;
  const bool sane = command.speed >= kSlowest && command.speed <= 1 &&
                    (command.tool_speed == 0 || command.tool_speed >= kSlowest) && command.zone >= 0 &&
                    command.acceleration >= kSlowest && command.acceleration <= 1;
  if (!sane || !from.allFinite()) {
    return {ErrorCode::Value};
  }
  if (const Fault fault = resolve(command, from, segment_.to, segment_.end); !fault.ok()) {
    return fault;
  }
  if (command.move == Move::Joint) {
    measure_joint_motion(command.speed);
    segment_.together = segment_.length > 0 && command.zone <= 0 && !command.straight;
    const Fault fault = begin_clear();
    return fault.ok() ? check_joint_way() : fault;
  }
  if (command.move == Move::Circle) {
    if (!finite(command.mid)) {
      return {ErrorCode::Value};
    }
    const Pose mid = command.mid.is_pose ? command.mid.pose : places_.arm().forward(command.mid.joints);
    if (const Fault fault = make_circle(mid.position); !fault.ok()) {
      return fault;
    }
  } else {
    segment_.way = (segment_.end.position - segment_.start.position).norm();
  }
  measure_tool_motion(command);
  return {};
}

// Axes that arrive together follow another path at another pace, so several paces are checked.
Fault Planner::check_joint_way() const noexcept {
  constexpr int kPlaces = 64;
  if (!places_.box().known()) {
    return {};
  }
  for (const double pace : {1.0, 0.7, 0.4, 0.1}) {
    Segment way = segment_;
    if (way.together) {
      way.take_joint_timing({way.from, Joints::Zero(), Joints::Zero()}, all_joints_, pace);
    }
    if (!places_.inside(way, kPlaces)) {
      return {ErrorCode::Workspace};
    }
  }
  return {};
}

// `spacing`: distance in m between places.
void Planner::begin_look(double spacing, int most) noexcept {
  Segment& s = segment_;
  bounds_.speed.fill(s.limits.velocity);
  bounds_.acceleration.fill(s.limits.acceleration);
  const double finest = std::max(s.way, 0.3 * s.turn.norm()) / spacing;
  count_ = std::clamp(static_cast<int>(std::min(finest, 1e6)), kFewestPlaces, most);
  samples_[0] = s.from;
  way_ = {places_.box(), s.start.position};
  volumes_[0] = volume(s.from);
  least_volume_ = std::abs(volumes_[0]);
  stage_ = Stage::Look;
  wanted_ = Profile::to_position({}, s.length, 0, s.limits).peak().velocity;
}

Fault Planner::check_next() noexcept {
  if (segment_.chain != nullptr) {
    segment_.source = segment_.chain->source_at(segment_.length / count_ * next_);
  }
  Joints& here = samples_[static_cast<std::size_t>(next_)];
  const Joints& before = samples_[static_cast<std::size_t>(next_) - 1];
  const double spacing = segment_.length / count_;
  if (const Fault fault = walk(spacing * (next_ - 1), before, spacing * next_, here); !fault.ok()) {
    return fault;
  }
  if (places_.box().known() && !way_.next(places_.arm().forward(here).position)) {
    return {ErrorCode::Workspace};
  }
  if (segment_.chain != nullptr) {
    bound_tool(next_);
  }
  volumes_[static_cast<std::size_t>(next_)] = volume(here);
  note_volume(volume(here), spacing * next_, here);
  if (misses_orientation(places_.arm(), segment_.pose_at(spacing * next_), here)) {
    weight_ = kSettlesSlowly;
  }
  return {};
}

// Goes from one place to another in as many steps as it takes to stay in the same posture: next to a singular position
// joints turn far over a short distance, and beyond it the nearest solution is often another posture. So is that behind
// a joint's limit, which may be near: what looks like it is divided further.
Fault Planner::walk(double from, const Joints& start, double to, Joints& q) noexcept {
  constexpr double kSure = radians(30);
  constexpr double kAtLimit = radians(1);
  const double finest = 1e-6 * segment_.length;
  const double finest_turn = 1e-9 * segment_.length;
  Joints before = start;
  double side = volume(start);
  for (double width = to - from; from < to;) {
    const double place = from + 1.001 * width >= to ? to : from + width;
    work_ += weight_;
    if (work_ > kMostWork) {
      return {ErrorCode::Singular};
    }
    if (const Reach reach = places_.on(segment_, place, before, q); reach != Reach::Ok) {
      return {code_of(reach)};
    }
    Eigen::Index axis = 0;
    const double jump = (q - before).cwiseAbs().maxCoeff(&axis);
    const double other = volume(q);
    const bool turns = jump > kSure && (width > finest || jump < kJump);
    if (width > (turns ? finest_turn : finest) && (turns || side * other < 0)) {
      width /= 2;
      continue;
    }
    if (jump > kSure) {
      // The continuation in this posture may be beyond a limit.
      const int ended = places_.arm().beyond_limits(before, -kAtLimit);
      return ended >= 0 ? Fault{ErrorCode::JointLimit, ended + 1}
                        : Fault{ErrorCode::Singular, static_cast<int>(axis) + 1};
    }
    before = q;
    side = other;
    from = place;
    width *= 2;
  }
  return {};
}

// 0 in singular positions, and of opposite sign on their two sides.
double Planner::volume(const Joints& q) const noexcept {
  return places_.arm().volume(q);
}

Fault Planner::look(int& places) noexcept {
  for (; places > 0 && next_ <= count_; --places, ++next_) {
    if (const Fault fault = check_next(); !fault.ok()) {
      return fault;
    }
    if (next_ == count_) {
      const double spacing = segment_.length / count_;
      for (int i = 0; i < count_; ++i) {
        const Rates rates = rates_at(samples_.data(), count_, i, spacing);
        note(rates);
        bound(rates, spacing * i, spacing, samples_[static_cast<std::size_t>(i)]);
      }
      choose_windows(samples_.data(), volumes_.data(), count_, 0, spacing, 0);
    }
  }
  for (; places > 0 && next_ > count_ && windows_ > 0; places -= kParts) {
    if (const Fault fault = look_closer(); !fault.ok()) {
      return fault;
    }
  }
  if (next_ <= count_ || windows_ > 0) {
    return {};
  }
  segment_.to = samples_[static_cast<std::size_t>(count_)];
  measure_tip();
  if (misses_orientation(places_.arm(), segment_.end, segment_.to)) {
    return {ErrorCode::Unreachable};
  }
  return begin_clear();
}

// What the arm cannot hold is rejected before it is rehearsed, which may take long.
Fault Planner::time_it() noexcept {
  if (places_.dynamics() != nullptr) {
    work_ += count_;
    int place = 0;
    if (const Fault fault = check_holding(*places_.dynamics(), samples_.data(), count_, place); !fault.ok()) {
      if (segment_.chain != nullptr) {
        segment_.source = segment_.chain->source_at(segment_.length / count_ * place);
      }
      return fault;
    }
  }
  for (int i = 0; i < noted_; ++i) {
    leave_for_changes(rates_[static_cast<std::size_t>(i)], joints_, segment_.limits);
  }
  // A path that may be blended has one speed for all of it; if that is far too slow, it comes to rest at its end
  // instead.
  if (segment_.limits.velocity < kSlowestPace * wanted_) {
    segment_.zone = 0;
  }
  if (segment_.zone <= 0) {
    search_.begin(segment_, bounds_);
    stage_ = Stage::Search;
  } else {
    rehearse_profile();
  }
  return {};
}

Fault Planner::check(int places) noexcept {
  while (places > 0 && stage_ != Stage::Done) {
    const bool looking = stage_ != Stage::Effort;
    switch (stage_) {
      case Stage::Look:
        if (const Fault fault = look(places); !fault.ok()) {
          stage_ = Stage::Done;
          return fault;
        }
        break;
      case Stage::Clear:
        if (const Fault fault = clear(places); !fault.ok()) {
          stage_ = Stage::Done;
          return fault;
        }
        break;
      case Stage::Search:
        places -= search();
        break;
      case Stage::RehearseTiming:
      case Stage::RehearseProfile:
        --places;
        work_ += weight_;
        rehearse();
        break;
      case Stage::Effort:
        --places;
        work_ += segment_.move == Move::Joint ? 1 : weight_ + 1;
        if (const Fault fault = effort_.look(segment_, may_refuse()); !fault.ok()) {
          stage_ = Stage::Done;
          return fault;
        }
        stage_ = effort_.done() ? Stage::Done : stage_;
        break;
      case Stage::Done:
        break;
    }
    const bool looked = stage_ == Stage::Done || stage_ == Stage::Effort;
    if (looking && looked && segment_.move != Move::Joint && (unseen_ || (may_refuse() && crawls()))) {
      stage_ = Stage::Done;
      return {ErrorCode::Singular};
    }
  }
  return {};
}

}  // namespace indurop::robot
