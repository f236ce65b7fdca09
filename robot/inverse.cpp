// SPDX-License-Identifier: Apache-2.0
#include "robot/inverse.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr int kSteps = 100;
constexpr double kNear = 1e-10;  // metres and radians

double error_of(const Arm& arm, const Pose& pose, const Joints& q, Twist& twist) noexcept {
  twist = difference(arm.forward(q), pose);
  return twist.squaredNorm();
}

Joints within_limits(const Arm& arm, Joints q) noexcept {
  for (int i = 0; i < kAxes; ++i) {
    const Axis& a = arm.axis(i);
    q[i] = a.endless ? q[i] : std::clamp(q[i], a.lower, a.upper);
  }
  return q;
}

}  // namespace

Inverse::Result solve_numerically(const Arm& arm, const Pose& pose, const Joints& near) noexcept {
  Joints q = within_limits(arm, near);
  Twist twist;
  double error = error_of(arm, pose, q, twist);
  double damping = 1e-3;
  for (int step = 0; step < kSteps && error > kNear * kNear && damping < 1e6; ++step) {
    const Jacobian j = arm.jacobian(q);
    Jacobian normal = j.transpose() * j;
    normal.diagonal().array() += damping;
    const Joints change = normal.ldlt().solve(j.transpose() * twist);
    // A step of half a turn leaves the neighbourhood where the linear model says anything.
    const Joints tried = within_limits(arm, q + change * std::min(1.0, 0.5 / change.lpNorm<Eigen::Infinity>()));
    Twist left;
    const double found = error_of(arm, pose, tried, left);
    if (found < error) {
      q = tried;
      error = found;
      twist = left;
      damping = std::max(damping / 5, 1e-12);
    } else {
      damping *= 4;
    }
  }
  constexpr double kGood = 1e-7;
  const bool at_limit = arm.beyond_limits(q, -1e-9) >= 0;
  const Reach missed = at_limit ? Reach::JointLimit : Reach::OutOfReach;
  return {error < kGood * kGood ? Reach::Ok : missed, {q, 0}};
}

Inverse::Result Inverse::nearest(const Pose& pose, const Joints& near,
                                 std::optional<std::uint8_t> posture) const noexcept {
  if (!wrist_) {
    return solve_numerically(arm_, pose, near);
  }
  const Solutions found = wrist_->solve(arm_, pose, near);
  Result best{found.reach, {}};
  double distance = HUGE_VAL;
  for (int i = 0; i < found.count; ++i) {
    const Solution& one = found.list[static_cast<std::size_t>(i)];
    const double away = (one.q - near).squaredNorm();
    if (away < distance && (!posture || one.posture == *posture)) {
      distance = away;
      best.solution = one;
    }
  }
  if (found.count > 0 && distance == HUGE_VAL) {
    best.reach = Reach::JointLimit;  // reachable, but not in this posture
  }
  return best;
}

Solutions Inverse::all(const Pose& pose, const Joints& near) const noexcept {
  if (wrist_) {
    return wrist_->solve(arm_, pose, near);
  }
  const Result one = solve_numerically(arm_, pose, near);
  Solutions found;
  found.reach = one.reach;
  found.count = one.reach == Reach::Ok ? 1 : 0;
  found.list[0] = one.solution;
  return found;
}

}  // namespace indurop::robot
