// SPDX-License-Identifier: Apache-2.0
// The closed form: the wrist's center depends on the first three axes alone. Axis 1 turns the center into the plane of
// axes 2 and 3 (two ways), these reach it like a compass (two ways), and the wrist makes up the orientation (two ways).

#include <cmath>

#include "robot/closed_forms.h"

namespace indurop::robot {

struct SphericalWrist::Search {
  const Arm& arm;
  const Joints& near;
  Mat3 rotation;  // of all six axes together
  Vec3 center;    // where the wrist has to be
  Solutions found{};
};

std::optional<SphericalWrist> SphericalWrist::of(const Arm& arm) {
  if (!arm.turns_six()) {
    return std::nullopt;
  }
  const Axis& a1 = arm.axis(0);
  const Axis& a2 = arm.axis(1);
  const Axis& a3 = arm.axis(2);
  const Axis& a4 = arm.axis(3);
  const Axis& a5 = arm.axis(4);
  const Axis& a6 = arm.axis(5);
  const bool posable = std::abs(a1.direction.dot(a2.direction)) < Close::kParallel &&
                       a2.direction.cross(a3.direction).norm() < Close::kParallel &&
                       a4.direction.cross(a5.direction).norm() > 1e-3 && a5.direction.cross(a6.direction).norm() > 1e-3;
  if (!posable) {
    return std::nullopt;
  }
  SphericalWrist form;
  form.center_ = nearest_point(a4, a5);
  form.plane_x_ = a1.direction;
  form.plane_y_ = a2.direction.cross(a1.direction);
  const auto in_plane = [&](const Vec3& v) { return Eigen::Vector2d(form.plane_x_.dot(v), form.plane_y_.dot(v)); };
  form.origin_ = in_plane(a2.point);
  form.compass_ = {in_plane(a3.point) - form.origin_, in_plane(form.center_) - in_plane(a3.point)};
  if (distance(a5, form.center_) > Close::kTouching || distance(a6, form.center_) > Close::kTouching ||
      form.compass_.upper.norm() < Close::kTouching || form.compass_.lower.norm() < Close::kTouching) {
    return std::nullopt;
  }
  form.third_sign_ = a2.direction.dot(a3.direction) > 0 ? 1 : -1;
  form.wrist_ = Wrist(a4.direction, a5.direction, a6.direction);
  return form;
}

Solutions SphericalWrist::solve(const Arm& arm, const Pose& pose, const Joints& near) const noexcept {
  Search search{arm, near, (pose.orientation * arm.home().orientation.conjugate()).toRotationMatrix(), Vec3::Zero()};
  search.center = pose.position + search.rotation * (center_ - arm.home().position);

  // In a frame on axis 1 the plane of the arm stands off by `offset`, whatever axes 2 and 3 do.
  const Axis& a1 = arm.axis(0);
  const Vec3 side = arm.axis(1).direction;
  const Vec3 across = a1.direction.cross(side);
  const Vec3 reach = search.center - a1.point;
  const double offset = side.dot(center_ - a1.point);
  const double x = side.dot(reach);
  const double y = across.dot(reach);
  // At joint angles zero the centre lies on one of the two sides: that one is "in front".
  const bool front = across.dot(center_ - a1.point) >= 0;
  for (const FirstTurns::Turn& turn : FirstTurns({x, y}, offset, front, near[0])) {
    with_first(search, turn.angle, turn.posture);
  }
  return search.found;
}

void SphericalWrist::with_first(Search& search, double q1, std::uint8_t posture) const noexcept {
  const Axis& a1 = search.arm.axis(0);
  const Vec3 center = turned(a1.direction, -q1) * (search.center - a1.point) + a1.point;
  const Eigen::Vector2d reach = Eigen::Vector2d(plane_x_.dot(center), plane_y_.dot(center)) - origin_;
  for (const int elbow : {0, 1}) {
    if (const auto angles = compass_.reach(reach, elbow != 0)) {
      with_arm(search, {q1, angles->first, third_sign_ * angles->second},
               static_cast<std::uint8_t>(posture | elbow * Solution::kElbow));
    }
  }
}

void SphericalWrist::with_arm(Search& search, const Eigen::Vector3d& first_three, std::uint8_t posture) const noexcept {
  Mat3 before = Mat3::Identity();
  for (int i = 0; i < 3; ++i) {
    before = before * turned(search.arm.axis(i).direction, first_three[i]);
  }
  for (const int turn : {0, 1}) {
    if (const auto wrist = wrist_.turn(before.transpose() * search.rotation, turn != 0, {true, search.near[3]})) {
      const Joints q =
          joints_of({first_three[0], first_three[1], first_three[2], wrist->first, wrist->middle, wrist->last});
      search.found.add(search.arm, q, static_cast<std::uint8_t>(posture | turn * Solution::kWrist), search.near);
    }
  }
}

}  // namespace indurop::robot
