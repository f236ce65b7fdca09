// SPDX-License-Identifier: Apache-2.0
// The closed form: the wrist's center depends on the first three axes alone. Axis 1 turns the center into the plane of
// axes 2 and 3 (two ways), these reach it like a compass (two ways), and the wrist makes up the orientation (two ways).

#include <algorithm>
#include <cmath>

#include "robot/inverse.h"

namespace indurop::robot {

namespace {

constexpr double kParallel = 1e-6;  // sine or cosine of angles that count as none
constexpr double kTouching = 1e-6;  // m, between lines that count as meeting
constexpr double kStretch = 1e-9;   // relative; a target just out of reach by rounding is at the reach
constexpr double kSingular = 1e-7;  // below, an angle says nothing any more

double angle_of(const Eigen::Vector2d& v) noexcept {
  return std::atan2(v.y(), v.x());
}

Eigen::Vector2d turned2(const Eigen::Vector2d& v, double angle) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

// The angle about `axis` from the direction of `from` to that of `to`.
double angle_about(const Vec3& axis, const Vec3& from, const Vec3& to) noexcept {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
}

// acos of a cosine that rounding may have put slightly beyond 1; nothing if it is far beyond.
std::optional<double> angle_with_cosine(double cosine) noexcept {
  if (!(std::abs(cosine) <= 1 + kStretch)) {
    return std::nullopt;
  }
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

// `angle` plus as many turns as bring it nearest to `near` within the axis' limits; nothing if none is within.
std::optional<double> turn_nearest(const Axis& axis, double angle, double near) noexcept {
  const double turn = 2 * kPi;
  double best = angle + turn * std::round((near - angle) / turn);
  if (axis.endless) {
    return best;
  }
  constexpr double kSlack = 1e-9;
  if (best > axis.upper + kSlack) {
    best -= turn * std::ceil((best - axis.upper - kSlack) / turn);
  } else if (best < axis.lower - kSlack) {
    best += turn * std::ceil((axis.lower - kSlack - best) / turn);
  }
  if (best > axis.upper + kSlack || best < axis.lower - kSlack) {
    return std::nullopt;
  }
  return std::clamp(best, axis.lower, axis.upper);
}

}  // namespace

struct SphericalWrist::Search {
  const Arm& arm;
  const Joints& near;
  Mat3 rotation;  // of all six axes together
  Vec3 center;    // where the wrist has to be
  Solutions found{};

  void add(const Joints& q, std::uint8_t posture) noexcept {
    Solution one{q, posture};
    for (int i = 0; i < kAxes; ++i) {
      const auto angle = turn_nearest(arm.axis(i), q[i], near[i]);
      if (!angle) {
        found.reach = found.count > 0 ? Reach::Ok : Reach::JointLimit;
        return;
      }
      one.q[i] = *angle;
    }
    found.list[static_cast<std::size_t>(found.count++)] = one;
    found.reach = Reach::Ok;
  }
};

std::optional<SphericalWrist> SphericalWrist::of(const Arm& arm) {
  const Axis& a1 = arm.axis(0);
  const Axis& a2 = arm.axis(1);
  const Axis& a3 = arm.axis(2);
  const Axis& a4 = arm.axis(3);
  const Axis& a5 = arm.axis(4);
  const Axis& a6 = arm.axis(5);
  const Vec3 normal = a4.direction.cross(a5.direction);
  const bool posable = std::abs(a1.direction.dot(a2.direction)) < kParallel &&
                       a2.direction.cross(a3.direction).norm() < kParallel && normal.norm() > 1e-3 &&
                       a5.direction.cross(a6.direction).norm() > 1e-3;
  if (!posable) {
    return std::nullopt;
  }
  SphericalWrist arm_form;
  // Foot of the common perpendicular on axis 4; where it has no length, and axis 6 comes by, the three meet.
  const Vec3 between = a5.point - a4.point;
  arm_form.center_ = a4.point + a4.direction * (between.cross(a5.direction).dot(normal) / normal.squaredNorm());
  const auto misses = [&](const Axis& a) { return a.direction.cross(arm_form.center_ - a.point).norm() > kTouching; };
  arm_form.plane_x_ = a1.direction;
  arm_form.plane_y_ = a2.direction.cross(a1.direction);
  const auto in_plane = [&](const Vec3& v) {
    return Eigen::Vector2d(arm_form.plane_x_.dot(v), arm_form.plane_y_.dot(v));
  };
  arm_form.origin_ = in_plane(a2.point);
  arm_form.upper_ = in_plane(a3.point) - arm_form.origin_;
  arm_form.lower_ = in_plane(arm_form.center_) - in_plane(a3.point);
  if (misses(a5) || misses(a6) || arm_form.upper_.norm() < kTouching || arm_form.lower_.norm() < kTouching) {
    return std::nullopt;
  }
  arm_form.third_sign_ = a2.direction.dot(a3.direction) > 0 ? 1 : -1;
  arm_form.constant_ = a4.direction.dot(a5.direction) * a5.direction.dot(a6.direction);
  arm_form.cosine_ = a4.direction.dot(a6.direction) - arm_form.constant_;
  arm_form.sine_ = a4.direction.dot(a5.direction.cross(a6.direction));
  return arm_form;
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
  const double radius = std::hypot(x, y);
  if (radius < kSingular) {
    if (std::abs(offset) < kSingular) {  // the wrist is on axis 1: any angle will do
      with_first(search, near[0], 0);
    }
    return search.found;
  }
  const auto half = angle_with_cosine(offset / radius);
  if (!half) {
    return search.found;
  }
  const double middle = std::atan2(y, x);
  // At joint angles zero the wrist lies on one of the two sides: that one is "in front".
  const std::uint8_t front = across.dot(center_ - a1.point) >= 0 ? 0 : Solution::kShoulder;
  with_first(search, middle - *half, front);
  with_first(search, middle + *half, static_cast<std::uint8_t>(front ^ Solution::kShoulder));
  return search.found;
}

void SphericalWrist::with_first(Search& search, double q1, std::uint8_t posture) const noexcept {
  const Axis& a1 = search.arm.axis(0);
  const Vec3 center = turned(a1.direction, -q1) * (search.center - a1.point) + a1.point;
  const Eigen::Vector2d reach = Eigen::Vector2d(plane_x_.dot(center), plane_y_.dot(center)) - origin_;
  const double a = upper_.norm();
  const double b = lower_.norm();
  const auto bend = angle_with_cosine((reach.squaredNorm() - a * a - b * b) / (2 * a * b));
  if (!bend) {
    return;
  }
  const double straight = angle_of(upper_) - angle_of(lower_);
  for (const int elbow : {0, 1}) {
    const double q3 = straight + (elbow == 0 ? *bend : -*bend);
    const double q2 = angle_of(reach) - angle_of(upper_ + turned2(lower_, q3));
    with_arm(search, {q1, q2, third_sign_ * q3}, static_cast<std::uint8_t>(posture | elbow * Solution::kElbow));
  }
}

void SphericalWrist::with_arm(Search& search, const Eigen::Vector3d& first_three, std::uint8_t posture) const noexcept {
  const Arm& arm = search.arm;
  const Vec3& w4 = arm.axis(3).direction;
  const Vec3& w5 = arm.axis(4).direction;
  const Vec3& w6 = arm.axis(5).direction;
  Mat3 before = Mat3::Identity();
  for (int i = 0; i < 3; ++i) {
    before = before * turned(arm.axis(i).direction, first_three[i]);
  }
  const Mat3 wrist = before.transpose() * search.rotation;
  const Vec3 wanted = wrist * w6;
  const auto half = angle_with_cosine((w4.dot(wanted) - constant_) / std::hypot(cosine_, sine_));
  if (!half) {
    return;
  }
  const double middle = std::atan2(sine_, cosine_);
  // Something perpendicular to axis 6, to see how far that is turned.
  const Vec3 mark = w6.unitOrthogonal();
  for (const int turn : {0, 1}) {
    Joints q;
    q.head<3>() = first_three;
    q[4] = middle + (turn == 0 ? *half : -*half);
    const Mat3 fifth = turned(w5, q[4]);
    const Vec3 bent = fifth * w6;
    const bool singular = w4.cross(bent).norm() < kSingular;
    q[3] = singular ? search.near[3] : angle_about(w4, bent, wanted);
    q[5] = angle_about(w6, mark, (turned(w4, q[3]) * fifth).transpose() * wrist * mark);
    search.add(q, static_cast<std::uint8_t>(posture | turn * Solution::kWrist));
  }
}

}  // namespace indurop::robot
