// SPDX-License-Identifier: Apache-2.0
// The closed form: the wrist's center depends on the first three axes alone. Axis 1 turns the center into the plane of
// axes 2 and 3 (two solutions), these reach it like the legs of a compass (two solutions), and the wrist yields the
// orientation (two solutions).

#include "control/robot/kinematics/spherical_wrist.h"

#include <array>
#include <cmath>
#include <utility>

namespace indurop::robot {

struct SphericalWrist::Search {
  Gathered gathered;
  Mat3 rotation;  // of all six axes together
  Vec3 center;    // required position of the wrist
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

Solutions SphericalWrist::solve(const Arm& arm, const Pose& pose, const Joints& near,
                                Gathered::What what) const noexcept {
  Search search{
      {arm, near, what}, (pose.orientation * arm.home().orientation.conjugate()).toRotationMatrix(), Vec3::Zero()};
  search.center = pose.position + search.rotation * (center_ - arm.home().position);

  // In a frame on axis 1 the plane of the arm has the distance `offset`, whatever axes 2 and 3 do.
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
    if (search.gathered.wants(search.gathered.away(0, turn.angle))) {
      with_first(search, turn.angle, turn.posture);
    }
  }
  return search.gathered.found();
}

void SphericalWrist::with_first(Search& search, double q1, std::uint8_t posture) const noexcept {
  const Gathered& gathered = search.gathered;
  const Axis& a1 = gathered.arm().axis(0);
  const Vec3 center = turned(a1.direction, -q1) * (search.center - a1.point) + a1.point;
  const Eigen::Vector2d reach = Eigen::Vector2d(plane_x_.dot(center), plane_y_.dot(center)) - origin_;
  struct Way {
    Vec3 angles;
    std::uint8_t posture = 0;
    double away = 0;
  };
  std::array<Way, 2> ways;
  std::size_t count = 0;
  for (const int elbow : {0, 1}) {
    if (const auto angles = compass_.reach(reach, elbow != 0)) {
      const Vec3 three(q1, angles->first, third_sign_ * angles->second);
      ways[count++] = {three, static_cast<std::uint8_t>(posture | elbow * Solution::kElbow),
                       gathered.away(0, three[0]) + gathered.away(1, three[1]) + gathered.away(2, three[2])};
    }
  }
  if (count == 2 && ways[1].away < ways[0].away) {
    std::swap(ways[0], ways[1]);
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (gathered.wants(ways[i].away)) {
      with_arm(search, ways[i].angles, ways[i].posture);
    }
  }
}

void SphericalWrist::with_arm(Search& search, const Eigen::Vector3d& first_three, std::uint8_t posture) const noexcept {
  Mat3 before = Mat3::Identity();
  for (int i = 0; i < 3; ++i) {
    before = before * turned(search.gathered.arm().axis(i).direction, first_three[i]);
  }
  for (const int turn : {0, 1}) {
    if (const auto wrist =
            wrist_.turn(before.transpose() * search.rotation, turn != 0, {true, search.gathered.near()[3]})) {
      const Joints q =
          joints_of({first_three[0], first_three[1], first_three[2], wrist->first, wrist->middle, wrist->last});
      search.gathered.add(q, static_cast<std::uint8_t>(posture | turn * Solution::kWrist));
    }
  }
}

}  // namespace indurop::robot
