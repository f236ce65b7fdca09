// SPDX-License-Identifier: Apache-2.0
// The closed form: the distance of the point where the last two axes meet from the plane of the parallel axes depends
// on axis 1 alone (two solutions); the sum of the parallel angles and the last two angles yield the orientation (two
// solutions); then axes 2 and 3 reach axis 4 like the legs of a compass (two solutions).

#include "control/robot/kinematics/parallel_axes.h"

#include <cmath>

namespace indurop::robot {

struct ParallelAxes::Search {
  Gathered gathered;
  Mat3 rotation;  // of all six axes together
  Vec3 shift;     // of all six axes together
  double q1 = 0;
};

std::optional<ParallelAxes> ParallelAxes::of(const Arm& arm) {
  if (!arm.turns_six()) {
    return std::nullopt;
  }
  const Axis& a2 = arm.axis(1);
  const Axis& a3 = arm.axis(2);
  const Axis& a4 = arm.axis(3);
  const Axis& a5 = arm.axis(4);
  const Axis& a6 = arm.axis(5);
  const auto angle = [](const Axis& a, const Axis& b) { return a.direction.cross(b.direction).norm(); };
  const bool posable = angle(a2, a3) < Close::kParallel && angle(a2, a4) < Close::kParallel &&
                       angle(arm.axis(0), a2) > 1e-3 && angle(a4, a5) > 1e-3 && angle(a5, a6) > 1e-3;
  if (!posable) {
    return std::nullopt;
  }
  ParallelAxes form;
  form.center_ = nearest_point(a5, a6);
  form.plane_x_ = a2.direction.unitOrthogonal();
  form.plane_y_ = a2.direction.cross(form.plane_x_);
  const auto in_plane = [&](const Vec3& v) { return Eigen::Vector2d(form.plane_x_.dot(v), form.plane_y_.dot(v)); };
  form.origin_ = in_plane(a2.point);
  form.compass_ = {in_plane(a3.point - a2.point), in_plane(a4.point - a3.point)};
  if (distance(a6, form.center_) > Close::kTouching || form.compass_.upper.norm() < Close::kTouching ||
      form.compass_.lower.norm() < Close::kTouching) {
    return std::nullopt;
  }
  form.third_sign_ = a2.direction.dot(a3.direction) > 0 ? 1 : -1;
  form.fourth_sign_ = a2.direction.dot(a4.direction) > 0 ? 1 : -1;
  form.wrist_ = Wrist(a2.direction, a5.direction, a6.direction);
  return form;
}

Solutions ParallelAxes::solve(const Arm& arm, const Pose& pose, const Joints& near,
                              Gathered::What what) const noexcept {
  Search search{
      {arm, near, what}, (pose.orientation * arm.home().orientation.conjugate()).toRotationMatrix(), Vec3::Zero()};
  search.shift = pose.position - search.rotation * arm.home().position;

  // side * (reach turned back about axis 1) = offset
  const Axis& a1 = arm.axis(0);
  const Vec3 side = arm.axis(1).direction;
  const Vec3 across = a1.direction.cross(side);
  const Vec3 reach = search.rotation * center_ + search.shift - a1.point;
  const double along = a1.direction.dot(side) * a1.direction.dot(reach);
  const double x = side.dot(reach) - along;
  const double y = across.dot(reach);
  const double offset = side.dot(center_ - a1.point) - along;
  // At joint angles zero the centre lies on one of the two sides: that one is "in front".
  const bool front = across.dot(center_ - a1.point) >= 0;
  for (const FirstTurns::Turn& turn : FirstTurns({x, y}, offset, front, near[0])) {
    if (search.gathered.wants(search.gathered.away(0, turn.angle))) {
      with_first(search, turn.angle, turn.posture);
    }
  }
  return search.gathered.found();
}

void ParallelAxes::with_first(Search& search, double q1, std::uint8_t posture) const noexcept {
  search.q1 = q1;
  const Gathered& gathered = search.gathered;
  const Mat3 rotation = turned(gathered.arm().axis(0).direction, -q1) * search.rotation;
  for (const int turn : {0, 1}) {
    const auto wrist = wrist_.turn(rotation, turn != 0, {false, gathered.near()[5]});
    if (wrist &&
        gathered.wants(gathered.away(0, q1) + gathered.away(4, wrist->middle) + gathered.away(5, wrist->last))) {
      with_wrist(search, *wrist, static_cast<std::uint8_t>(posture | turn * Solution::kWrist));
    }
  }
}

void ParallelAxes::with_wrist(Search& search, const Wrist::Angles& wrist, std::uint8_t posture) const noexcept {
  const Arm& arm = search.gathered.arm();
  const Axis& a1 = arm.axis(0);
  const Mat3 wrist_turn = turned(arm.axis(4).direction, wrist.middle) * turned(arm.axis(5).direction, wrist.last);
  // The required position of axis 4: first relative to the wrist in the tool's frame, then before axis 1.
  const Vec3 behind = center_ + wrist_turn.transpose() * (arm.axis(3).point - center_);
  const Vec3 there = search.rotation * behind + search.shift;
  const Vec3 before = turned(a1.direction, -search.q1) * (there - a1.point) + a1.point;
  const Eigen::Vector2d reach = Eigen::Vector2d(plane_x_.dot(before), plane_y_.dot(before)) - origin_;
  for (const int elbow : {0, 1}) {
    if (const auto angles = compass_.reach(reach, elbow != 0)) {
      const double fourth = wrist.first - angles->first - angles->second;
      const Joints q = joints_of(
          {search.q1, angles->first, third_sign_ * angles->second, fourth_sign_ * fourth, wrist.middle, wrist.last});
      search.gathered.add(q, static_cast<std::uint8_t>(posture | elbow * Solution::kElbow));
    }
  }
}

}  // namespace indurop::robot
