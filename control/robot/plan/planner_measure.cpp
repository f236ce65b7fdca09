// SPDX-License-Identifier: Apache-2.0
// The geometric properties of a path: circles, lengths, and the limits set by the tool and the command.

#include <algorithm>
#include <cmath>

#include "control/robot/plan/planner.h"

namespace indurop::robot {

namespace {

constexpr double kMeasureSpacing = 0.01;  // m between checked places

}  // namespace

Fault Planner::make_circle(const Vec3& mid) noexcept {
  const Vec3 a = mid - segment_.start.position;
  const Vec3 b = segment_.end.position - segment_.start.position;
  const Vec3 normal = a.cross(b);
  const double area = normal.squaredNorm();
  if (area < 1e-6 * a.squaredNorm() * b.squaredNorm() || area <= 0) {
    return {ErrorCode::Circle};
  }
  segment_.center =
      segment_.start.position + (a.squaredNorm() * b.cross(normal) - b.squaredNorm() * a.cross(normal)) / (2 * area);
  segment_.radius_x = segment_.start.position - segment_.center;
  // The normal is such that the path from start through mid to end turns left about it.
  segment_.radius_y = normal.normalized().cross(segment_.radius_x);
  const Vec3 last = segment_.end.position - segment_.center;
  segment_.angle = std::atan2(segment_.radius_y.dot(last), segment_.radius_x.dot(last));
  if (segment_.angle <= 0) {
    segment_.angle += 2 * kPi;
  }
  segment_.way = segment_.angle * segment_.radius_x.norm();
  return {};
}

void Planner::measure_joint_motion(double speed) noexcept {
  const Joints change = segment_.to - segment_.from;
  segment_.length = change.cwiseAbs().cwiseQuotient(joints_.velocity).maxCoeff();
  if (segment_.length <= 0) {
    return;
  }
  segment_.speed = speed;
  segment_.limits = {speed, HUGE_VAL, HUGE_VAL};
  for (int i = 0; i < kAxes; ++i) {
    const double rate = std::abs(change[i]) / segment_.length;
    segment_.limits.acceleration = std::min(segment_.limits.acceleration, shared(joints_.acceleration[i], rate));
    segment_.limits.jerk = std::min(segment_.limits.jerk, shared(joints_.jerk[i], rate));
  }
  constexpr int kPlaces = 64;
  TipSpeed tip(places_.arm());
  tip.begin(segment_.from);
  for (int i = 1; i <= kPlaces; ++i) {
    tip.note(segment_.joints_at(segment_.length * i / kPlaces));
  }
  segment_.tip_speed = tip.farthest() * kPlaces / segment_.length;
}

// Tip speed of a motion of the tool, from the checked places.
void Planner::measure_tip() noexcept {
  TipSpeed tip(places_.arm());
  tip.begin(samples_[0]);
  for (int i = 1; i <= count_; ++i) {
    tip.note(samples_[static_cast<std::size_t>(i)]);
  }
  segment_.tip_speed = tip.farthest() * count_ / segment_.length;
}

void Planner::measure_tool_motion(const MoveCommand& command) noexcept {
  Segment& s = segment_;
  s.turn = rotation_between(s.start.orientation, s.end.orientation);
  const double angle = s.turn.norm();
  s.length = std::max(s.way / tool_.velocity, angle / tool_.turn_velocity);
  if (s.length <= 1e-9) {
    s.length = 0;
    s.to = s.from;  // the joint angles of the target may be another posture
    return;
  }
  const double pace = s.way / s.length;
  const double turning = angle / s.length;
  s.limits.velocity = command.speed;
  if (command.tool_speed > 0) {
    s.limits.velocity = std::min(1.0, shared(command.tool_speed, pace));
  }
  double acceleration = tool_.acceleration;
  if (s.move == Move::Circle) {
    // Half of the acceleration holds the tool on the circle.
    const double bend = pace * pace / s.radius_x.norm();
    s.limits.velocity = std::min(s.limits.velocity, std::sqrt(shared(acceleration / 2, bend)));
    acceleration /= 2;
  }
  s.limits.acceleration = std::min(shared(acceleration, pace), shared(tool_.turn_acceleration, turning));
  s.limits.jerk = std::min(shared(tool_.jerk, pace), shared(tool_.turn_jerk, turning));
  s.most = s.limits;
  begin_look(kMeasureSpacing, kMost / 2);
}

}  // namespace indurop::robot
