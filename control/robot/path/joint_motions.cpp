// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/joint_motions.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kAtTarget = 1e-9;        // rad
constexpr int kWorkspaceSamples = 24;     // of a new path
constexpr int kCollisionSamples = 64;     // of a new path: more take too long
constexpr double kSameWay = 0.84;         // up to this pace, axes that arrive together take the path of full pace
constexpr double kJointRounding = 1e-9;   // rad/s
constexpr double kNearlyFull = 1 - 1e-9;  // a pace that leaves a margin for changes of the pace

// Returns whether a joint that brakes at once comes to rest beyond its target.
bool passes(double position, double target, double stop) noexcept {
  return (target - position) * (target - stop) < 0 && std::abs(target - stop) > kAtTarget;
}

}  // namespace

// Checks a timing for a pace below 1, which brakes later and more softly: returns whether no joint gets too fast or too
// far, or turns back only because it cannot end its braking in time.
bool JointMotions::can_begin(const JointState& now, double pace, const JointLimits& limits) const noexcept {
  const JointLimits shared = limits_for(limits, 1, JointShares::at(pace));
  const JointState real{now.position, pace * now.velocity, pace * pace * now.acceleration};
  const Joints later = pace * JointTiming::unloaded(now, shared);
  const Joints sooner = JointTiming::unloaded(real, limits);
  for (int i = 0; i < kAxes; ++i) {
    const double v = real.velocity[i];
    if (std::abs(later[i]) > limits.velocity[i] * (1 + 1e-9) ||
        (v * later[i] < 0 && v * sooner[i] > -kJointRounding * std::abs(v))) {
      return false;
    }
  }
  return places_.arm().goes_beyond(now.position, JointTiming::stopping(now, shared), 1e-9) < 0;
}

double JointMotions::tip_speed_of(const Segment& segment) const noexcept {
  constexpr int kPlaces = 64;
  TipSpeed tip(places_.arm());
  tip.begin(segment.joints_at(0));
  for (int i = 1; i <= kPlaces; ++i) {
    tip.note(segment.joints_at(segment.length * i / kPlaces));
  }
  return segment.length > 0 ? tip.farthest() * kPlaces / segment.length : 0;
}

void JointMotions::time(Segment& segment, double pace) const noexcept {
  time(segment, {segment.from, Joints::Zero(), Joints::Zero()}, limits_, pace);
}

void JointMotions::time(Segment& segment, const JointState& from, const JointLimits& limits,
                        double pace) const noexcept {
  const auto take = [&] { segment.take_joint_timing(from, limits, segment.moving ? pace : made_for(pace)); };
  take();
  for (int again = 0; again < 3 && std::isfinite(tip_limit_); ++again) {
    segment.tip_speed = tip_speed_of(segment);
    const double slower = pace_for(segment.tip_speed);
    if (pace <= slower || segment.moving) {
      break;
    }
    pace = slower;
    take();
  }
}

Fault JointMotions::begin(Segment& segment, const Beginning& from, double pace) noexcept {
  constexpr double kNotExact = 0.98;  // factor on the jerk, where the present acceleration is not known exactly
  const JointState& now = from.now;
  if (const int beyond = places_.arm().goes_beyond(now.position, JointTiming::stopping(now, limits_), 1e-6);
      beyond >= 0) {
    return {ErrorCode::JointLimit, beyond + 1};
  }
  const double least = std::max(now.velocity.cwiseAbs().cwiseQuotient(limits_.velocity).maxCoeff(),
                                std::sqrt(now.acceleration.cwiseAbs().cwiseQuotient(limits_.acceleration).maxCoeff()));
  pace = places_.clearance().known() ? std::min(pace, kNearlyFull) : pace;
  JointState seen = now;
  for (const double tried : {std::max(pace, least), kNearlyFull, 1.0}) {
    if (!from.moving || (pace >= 1 && tried < 1)) {
      continue;
    }
    pace = std::min(tried, 1.0);
    seen = {now.position, now.velocity / pace, now.acceleration / (pace * pace)};
    if (pace >= 1 || can_begin(seen, pace, limits_)) {
      break;
    }
  }
  JointLimits limits = limits_;
  limits.jerk *= from.exact ? 1 : kNotExact;
  segment.moving = from.moving;
  time(segment, seen, limits, pace);
  if (!places_.inside(segment, kWorkspaceSamples)) {
    return {ErrorCode::Workspace};
  }
  if (segment.moving && pace > pace_for(segment.tip_speed)) {
    return {ErrorCode::Speed};
  }
  return check_collisions(segment);
}

// If there are bodies that could touch, a motion from rest takes the checked path, that of full pace, and has a margin
// so that it stays on it at a hold or another override.
double JointMotions::made_for(double pace) const noexcept {
  return places_.clearance().known() ? std::min(pace, kSameWay) : pace;
}

// Checks a joint motion that was not planned by the planner for collisions.
Fault JointMotions::check_collisions(const Segment& segment) noexcept {
  if (!places_.clearance().known()) {
    return {};
  }
  constexpr double kParts = 8;  // one of this many parts of the path is the longest step
  collisions_.begin(segment.joints_at(0), places_.tool());
  ClearWalk walk;
  walk.begin(segment.length, segment.length / kParts);
  const auto at = [&](double place, const Joints&, Joints& q) {
    q = segment.joints_at(place);
    return true;
  };
  const bool clear = walk.all(collisions_, kCollisionSamples, at);
  return clear ? Fault{} : Fault{ErrorCode::Collision, 0, collisions_.pair(), walk.place() / segment.length};
}

bool JointMotions::leave_margin(Segment& segment, double place) noexcept {
  const JointState now = segment.joint_timing.at(place);
  const JointLimits limits = segment.slowed(limits_);
  const Joints soon = JointTiming::stopping(now, limits);
  const Joints late = JointTiming::stopping(now, limits_for(limits, 1, JointShares::at(kNearlyFull)));
  for (int i = 0; i < kAxes; ++i) {
    const double target = segment.to[i];
    if (passes(now.position[i], target, late[i]) && !passes(now.position[i], target, soon[i])) {
      return false;
    }
  }
  if (!can_begin(now, kNearlyFull, limits)) {
    return false;
  }
  if (places_.box().known() || places_.clearance().known()) {
    Segment other = segment;
    other.take_joint_timing(now, limits_, kNearlyFull);
    if (!places_.inside(other, kWorkspaceSamples) || !check_collisions(other).ok()) {
      return false;
    }
  }
  segment.moving = true;
  time(segment, now, limits_, kNearlyFull);
  return true;
}

}  // namespace indurop::robot
