// SPDX-License-Identifier: Apache-2.0
// Joint motions whose axes arrive together, from rest or from any motion of the joints.

#include <algorithm>
#include <cmath>

#include "control/robot/path/follower.h"

namespace indurop::robot {

namespace {

constexpr double kThere = 1e-9;           // rad
constexpr int kLooks = 24;                // samples of a new path for the workspace check
constexpr int kClearLooks = 64;           // samples of a new path for the collision check: more take too long
constexpr double kSameWay = 0.84;         // up to this pace, axes that arrive together take the path of full pace
constexpr double kJointRounding = 1e-9;   // rad/s
constexpr double kNearlyFull = 1 - 1e-9;  // a pace that leaves a margin for changes of the pace

// Returns whether a joint that brakes at once comes to rest beyond its target.
bool passes(double position, double target, double stop) noexcept {
  return (target - position) * (target - stop) < 0 && std::abs(target - stop) > kThere;
}

}  // namespace

// Computes the motion of the joints by differences of places a little ahead, or back where the path ends.
Reach Follower::motion(JointState& now) const noexcept {
  now = {q_, Joints::Zero(), Joints::Zero()};
  if (at_rest()) {
    return Reach::Ok;
  }
  double v = state_.velocity;
  double a = state_.acceleration;
  if (segment(0).timed && segment(0).move == Move::Joint) {
    const JointState path = segment(0).joint_timing.at(state_.position);
    now = {path.position, v * path.velocity, v * v * path.acceleration + a * path.velocity};
    return Reach::Ok;
  }
  const double size = places_.inverse().closed_form() ? 2e-5 : 1e-3;
  const double step = left() > 3 * size ? size : -size;
  std::array<Joints, 4> f;
  f.fill(q_);
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (const Reach reach = joints_ahead(step * static_cast<double>(i), q_, f[i]); reach != Reach::Ok) {
      return reach;
    }
  }
  const Joints first = (4 * f[1] - 3 * f[0] - f[2]) / (2 * step);
  const Joints second = (2 * f[0] - 5 * f[1] + 4 * f[2] - f[3]) / (step * step);
  now.velocity = v * first;
  now.acceleration = v * v * second + a * first;
  return Reach::Ok;
}

// Checks a timing for a pace below 1, which brakes later and more softly: returns whether no joint gets too fast or too
// far, or turns back only because it cannot end its braking in time.
bool Follower::can_begin(const JointState& now, double pace, const JointLimits& most) const noexcept {
  const JointLimits limits = limits_for(most, 1, JointShares::at(pace));
  const JointState real{now.position, pace * now.velocity, pace * pace * now.acceleration};
  const Joints later = pace * JointTiming::unloaded(now, limits);
  const Joints sooner = JointTiming::unloaded(real, most);
  for (int i = 0; i < kAxes; ++i) {
    const double v = real.velocity[i];
    if (std::abs(later[i]) > most.velocity[i] * (1 + 1e-9) ||
        (v * later[i] < 0 && v * sooner[i] > -kJointRounding * std::abs(v))) {
      return false;
    }
  }
  return places_.arm().goes_beyond(now.position, JointTiming::stopping(now, limits), 1e-9) < 0;
}

// Returns the tip speed of a joint motion, as far as samples along it show.
double Follower::measured_tip_speed(const Segment& segment) const noexcept {
  constexpr int kPlaces = 64;
  TipSpeed tip(places_.arm());
  tip.begin(segment.joints_at(0));
  for (int i = 1; i <= kPlaces; ++i) {
    tip.note(segment.joints_at(segment.length * i / kPlaces));
  }
  return segment.length > 0 ? tip.farthest() * kPlaces / segment.length : 0;
}

// Makes a timing for a pace, or for a slower one at which the tip keeps its limit. A motion that begins in motion keeps
// its pace.
void Follower::make_joint_timing(Segment& segment, const JointState& from, const JointLimits& limits,
                                 double pace) noexcept {
  const auto take = [&] { segment.take_joint_timing(from, limits, segment.moving ? pace : made_for(pace)); };
  take();
  for (int again = 0; again < 3 && std::isfinite(tip_limit_); ++again) {
    segment.tip_speed = measured_tip_speed(segment);
    const double slower = pace_for(segment.tip_speed);
    if (pace <= slower || segment.moving) {
      break;
    }
    pace = slower;
    take();
  }
}

// The timing is made for the requested pace, as far as the present motion of the joints can be part of it at that pace.
Fault Follower::redirect(const Segment& target) noexcept {
  constexpr double kNotExact = 0.98;  // factor on the jerk, where the present acceleration is not known exactly
  JointState now;
  if (motion(now) != Reach::Ok) {
    return {ErrorCode::Singular};
  }
  if (const int beyond = places_.arm().goes_beyond(now.position, JointTiming::stopping(now, most_), 1e-6);
      beyond >= 0) {
    return {ErrorCode::JointLimit, beyond + 1};
  }
  const double least = std::max(now.velocity.cwiseAbs().cwiseQuotient(most_.velocity).maxCoeff(),
                                std::sqrt(now.acceleration.cwiseAbs().cwiseQuotient(most_.acceleration).maxCoeff()));
  double pace = places_.clearance().known() ? std::min(wanted_pace(), kNearlyFull) : wanted_pace();
  JointState seen = now;
  for (const double tried : {std::max(pace, least), kNearlyFull, 1.0}) {
    if (at_rest() || (pace >= 1 && tried < 1)) {
      continue;
    }
    pace = std::min(tried, 1.0);
    seen = {now.position, now.velocity / pace, now.acceleration / (pace * pace)};
    if (pace >= 1 || can_begin(seen, pace, most_)) {
      break;
    }
  }
  JointLimits limits = most_;
  limits.jerk *= at_rest() || (segment(0).move == Move::Joint && !in_blend_) ? 1 : kNotExact;
  Segment next = target;
  next.moving = !at_rest();
  make_joint_timing(next, seen, limits, pace);
  if (!places_.inside(next, kLooks)) {
    return {ErrorCode::Workspace};
  }
  if (next.moving && pace > pace_for(next.tip_speed)) {
    return {ErrorCode::Speed};
  }
  pace = next.made_for;
  if (const Fault fault = stays_clear(next); !fault.ok()) {
    return fault;
  }
  segments_[0] = next;
  count_ = 1;
  blend_ = {};
  in_blend_ = false;
  state_ = {0, pace, 0};
  past_.moved.fill(pace * period_);
  time_ = 0;
  return {};
}

// If there are bodies that could touch, a motion from rest takes the checked path, that of full pace, and has a margin
// so that it stays on it at a hold or another override.
double Follower::made_for(double pace) const noexcept {
  return places_.clearance().known() ? std::min(pace, kSameWay) : pace;
}

// Checks a joint motion that was not planned by the planner for collisions.
Fault Follower::stays_clear(const Segment& way) noexcept {
  if (!places_.clearance().known()) {
    return {};
  }
  constexpr double kParts = 8;  // one of this many parts of the path is the longest step
  clear_.begin(way.joints_at(0), places_.tool());
  ClearWalk walk;
  walk.begin(way.length, way.length / kParts);
  const auto at = [&](double place, const Joints&, Joints& q) {
    q = way.joints_at(place);
    return true;
  };
  const bool clear = walk.all(clear_, kClearLooks, at);
  return clear ? Fault{} : Fault{ErrorCode::Collision, 0, clear_.pair(), walk.place() / way.length};
}

// Changes from full limits to a timing that leaves a margin for changes of the pace. Not possible where a joint could
// then not come to rest before its target: the motion continues to its end, which takes no longer than braking.
bool Follower::leave_shares() noexcept {
  Segment& s = segments_[0];
  const JointState now = s.joint_timing.at(state_.position);
  const JointLimits most = s.slowed(most_);
  const Joints soon = JointTiming::stopping(now, most);
  const Joints late = JointTiming::stopping(now, limits_for(most, 1, JointShares::at(kNearlyFull)));
  for (int i = 0; i < kAxes; ++i) {
    if (passes(now.position[i], s.to[i], late[i]) && !passes(now.position[i], s.to[i], soon[i])) {
      return false;
    }
  }
  if (!can_begin(now, kNearlyFull, most)) {
    return false;
  }
  if (places_.box().known() || places_.clearance().known()) {
    Segment other = s;
    other.take_joint_timing(now, most_, kNearlyFull);
    if (!places_.inside(other, kLooks) || !stays_clear(other).ok()) {
      return false;
    }
  }
  s.moving = true;
  make_joint_timing(s, now, most_, kNearlyFull);
  state_ = {0, 1, 0};
  return true;
}

// Records the speed after a period.
void Follower::note_place(double seconds) noexcept {
  if (!segment(0).timed) {
    speed_ = state_.velocity;
    acceleration_ = state_.acceleration;
    return;
  }
  if (segment(0).move == Move::Joint) {
    note_joints(seconds);
    return;
  }
  passed_ = {segment(0).timing.at(state_.position).place, passed_[0], passed_[1]};
  const double speed = (passed_[0] - passed_[1]) / seconds;
  acceleration_ = (speed - speed_) / seconds;
  speed_ = speed;
}

// The speed is that of the fastest joint.
void Follower::note_joints(double seconds) noexcept {
  const Joints moved = past_.joints[0] - past_.joints[1];
  const double speed = moved.cwiseAbs().cwiseQuotient(most_.velocity).maxCoeff() / seconds;
  acceleration_ = (speed - speed_) / seconds;
  speed_ = speed;
}

PathAhead::Shape Follower::shape_ahead(double distance) const noexcept {
  Shape shape;
  const double place = std::min(state_.position + distance, segment(0).length);
  const JointState state = segment(0).joint_timing.at(place, &shape.third);
  shape.value = state.position;
  shape.first = state.velocity;
  shape.second = state.acceleration;
  return shape;
}

Timed Follower::timed_ahead(double distance) const noexcept {
  Timed there = segment(0).timing.at(state_.position + distance);
  there.place -= passed_[0];
  return there;
}

Reach Follower::joints_on_path(double along, const Joints& near, Joints& q) const noexcept {
  return is_timed() ? places_.on_path(segment(0), passed_[0] + along, near, q) : joints_ahead(along, near, q);
}

// Returns the further course of the pace of a motion with a timing.
Profile Follower::pace_of_timing(double seconds) noexcept {
  Segment& s = segments_[0];
  double wanted = wanted_pace();
  if (state_.position <= 0 && !s.moving) {
    // Before the motion begins, the pace may jump.
    if (s.move == Move::Joint && s.made_for != made_for(wanted)) {
      make_joint_timing(s, {s.from, Joints::Zero(), Joints::Zero()}, most_, wanted);
    }
    state_ = {0, s.move == Move::Joint ? std::min(wanted, s.fastest) : wanted, 0};
  }
  if (s.move == Move::Joint) {
    if (s.made_for >= 1 && (wanted >= 1 || !leave_shares())) {
      return Profile::coast(state_);
    }
    if (state_.position < s.settled || (wanted == state_.velocity && state_.acceleration == 0)) {
      return Profile::coast(state_);
    }
    wanted = std::min(wanted, s.fastest);
  }
  return pace_.next(state_, wanted, seconds, s.pace_limits);
}

}  // namespace indurop::robot
