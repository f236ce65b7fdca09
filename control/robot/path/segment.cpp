// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/segment.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/rates.h"

namespace indurop::robot {

Joints Segment::joints_at(double place) const noexcept {
  if (timed) {
    return joint_timing.at(place).position;
  }
  const double part = length > 0 ? std::clamp(place / length, 0.0, 1.0) : 1;
  return from + part * (to - from);
}

Segment Segment::together_to(const Joints& to, double speed) noexcept {
  Segment segment;
  segment.to = to;
  segment.speed = segment.limits.velocity = speed;
  segment.together = true;
  return segment;
}

JointLimits Segment::slowed(const JointLimits& joints) const noexcept {
  const JointLimits part = gentler(joints, acceleration);
  const double square = slowness * slowness;
  return {part.velocity / slowness, part.acceleration / square, part.jerk / (square * slowness)};
}

LineLimits Segment::straight_limits(const JointLimits& joints, double hardness) const noexcept {
  LineLimits result{limits.velocity, HUGE_VAL, HUGE_VAL};
  for (int i = 0; i < kAxes; ++i) {
    const double rate = std::abs(to[i] - from[i]) / length;
    result.acceleration = std::min(result.acceleration, shared(hardness * joints.acceleration[i], rate));
    result.jerk = std::min(result.jerk, shared(hardness * hardness * joints.jerk[i], rate));
  }
  return result;
}

double Segment::duration() const noexcept {
  return timing.known() ? timing.duration() : Profile::to_position({}, length, 0, limits).duration();
}

void Segment::take_timing() noexcept {
  stretch = length;
  length = timing.duration();
  tip_speed = timing_tip_speed;
  timed = true;
}

void Segment::take_joint_timing(const JointState& state, const JointLimits& joints, double pace) noexcept {
  const JointShares shares = JointShares::at(pace);
  const JointLimits all = slowed(joints);
  const JointLimits own = limits_for(all, speed, shares);
  joint_timing.plan(state, to, own);
  from = state.position;
  length = joint_timing.duration();
  timed = true;
  made_for = pace;
  fastest = pace < 1 ? shares.fastest() : 1;
  pace_limits = joint_timing.pace_limits(all, shares);
  settled = JointTiming::settling(state, own, all.velocity);
}

Pose Segment::pose_at(double place) const noexcept {
  return pose_on_path(timed ? timing.at(place).place : place);
}

Pose Segment::pose_on_path(double along) const noexcept {
  return wave.on() ? wave.shifted(calm_at(along), way_at(along)) : calm_at(along);
}

double Segment::part_at(double along) const noexcept {
  return length > 0 ? std::clamp(along / (timed ? stretch : length), 0.0, 1.0) : 1;
}

PathWay Segment::way_at(double along) const noexcept {
  if (chain != nullptr) {
    return chain->way_at(along);
  }
  const double part = part_at(along);
  const Vec3 ahead = move == Move::Circle ? Vec3(std::cos(part * angle) * radius_y - std::sin(part * angle) * radius_x)
                                          : Vec3(end.position - start.position);
  return {part * way, way, ahead};
}

Pose Segment::calm_at(double along) const noexcept {
  if (chain != nullptr) {
    return chain->pose_at(along);
  }
  const double part = part_at(along);
  Pose pose;
  pose.orientation = start.orientation * rotation_by(part * turn);
  if (move == Move::Circle) {
    pose.position = center + std::cos(part * angle) * radius_x + std::sin(part * angle) * radius_y;
  } else {
    pose.position = start.position + part * (end.position - start.position);
  }
  return pose;
}

void Blend::parts_at(double place, double& first, double& second) const noexcept {
  // The speed of the second path rises from 0 to 1, that of the first falls in the same way: two fifths of the time
  // with constant jerk, a fifth with constant acceleration, two fifths with jerk again.
  const double u = length() > 0 ? std::clamp(place / length(), 0.0, 1.0) : 1;
  const double at_end = std::min(u, 1 - u);
  double part = 25.0 / 36 * at_end * at_end * at_end;
  if (u > 0.4 && u < 0.6) {
    part = 2.0 / 45 + (u - 0.4) * (1.0 / 3 + 5.0 / 6 * (u - 0.4));
  } else if (u >= 0.6) {
    part += u - 0.5;
  }
  second = length() * part;
  first = place - zone - second;
}

bool Places::inside(const Segment& segment, int parts) const noexcept {
  WayInside way(box_, arm_->forward(segment.joints_at(0)).position);
  for (int i = 1; i <= parts && box_.known(); ++i) {
    if (!way.next(arm_->forward(segment.joints_at(segment.length * i / parts)).position)) {
      return false;
    }
  }
  return true;
}

Reach Places::on(const Segment& segment, double place, const Joints& near, Solution& solution) const noexcept {
  if (segment.move == Move::Joint) {
    solution = {segment.joints_at(place), 0};
    return Reach::Ok;
  }
  if (segment.joint_path != nullptr) {
    solution = {segment.joint_path->at(segment.timed ? segment.timing.at(place).place : place), 0};
    return Reach::Ok;
  }
  const double along = segment.timed ? segment.timing.at(place).place : place;
  const auto found = inverse_->nearest(segment.pose_on_path(along), held_at(segment, along, near));
  if (found.reach == Reach::Ok) {
    solution = found.solution;
  }
  return found.reach;
}

Reach Places::on_path(const Segment& segment, double along, const Joints& near, Joints& q) const noexcept {
  if (segment.joint_path != nullptr) {
    q = segment.joint_path->at(along);
    return Reach::Ok;
  }
  const auto found = inverse_->nearest(segment.pose_on_path(along), held_at(segment, along, near));
  if (found.reach == Reach::Ok) {
    q = found.solution.q;
  }
  return found.reach;
}

Reach Places::on(const Segment& segment, double place, const Joints& near, Joints& q) const noexcept {
  Solution solution{q, 0};
  const Reach reach = on(segment, place, near, solution);
  q = solution.q;
  return reach;
}

Reach Places::on(const Segment& first, const Blend& blend, const Segment& second, double place, const Joints& near,
                 Joints& q) const noexcept {
  double before = 0;
  double behind = 0;
  blend.parts_at(place, before, behind);
  before += first.length;
  if (first.move != Move::Joint && second.move != Move::Joint) {
    const Pose a = first.pose_at(before);
    const Pose b = second.pose_at(behind);
    const Pose& corner = second.start;
    const Pose pose{a.position + (b.position - corner.position),
                    a.orientation * (corner.orientation.conjugate() * b.orientation)};
    Joints elbow = second.from;
    if (first.elbow_moves || second.elbow_moves) {
      elbow = held_at(first, before, elbow) + (held_at(second, behind, elbow) - second.from);
    }
    const auto found = inverse_->nearest(pose, inverse_->held_as(elbow, near));
    if (found.reach == Reach::Ok) {
      q = found.solution.q;
    }
    return found.reach;
  }
  // At least one of them is a joint path: the sum is made of joint angles, and the contribution of that path determines
  // the posture of the other one.
  Joints a;
  Joints b;
  Reach reach = Reach::Ok;
  if (first.move == Move::Joint) {
    a = first.joints_at(before);
    reach = on(second, behind, near - (a - second.from), b);
  } else {
    b = second.joints_at(behind);
    reach = on(first, before, near - (b - second.from), a);
  }
  if (reach == Reach::Ok) {
    q = a + (b - second.from);
  }
  return reach;
}

}  // namespace indurop::robot
