// SPDX-License-Identifier: Apache-2.0
#include "robot/numeric.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr int kSteps = 100;
constexpr double kNear = 1e-10;  // metres and radians
constexpr double kGood = 1e-7;   // the same, of a place on a path
constexpr double kExact = 1e-9;  // of a solution that was searched
constexpr double kClose = 1e-3;  // worth more steps

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

struct Descent {
  int steps = kSteps;
  bool limited = true;  // stays within the limits all the way
};

// Returns the square of what is left.
double descend(const Arm& arm, const Pose& pose, const Descent& how, Joints& q) noexcept {
  const auto allowed = [&](const Joints& there) { return how.limited ? within_limits(arm, there) : there; };
  q = allowed(q);
  Twist twist;
  double error = error_of(arm, pose, q, twist);
  double damping = 1e-3;
  for (int step = 0; step < how.steps && error > kNear * kNear && damping < 1e6; ++step) {
    const Jacobian j = arm.jacobian(q);
    Eigen::Matrix<double, kAxes, kAxes> normal = j.transpose() * j;
    normal.diagonal().array() += damping;
    const Joints change = normal.ldlt().solve(j.transpose() * twist);
    // A step of half a turn leaves the neighbourhood where the linear model says anything.
    const Joints tried = allowed(q + change * std::min(1.0, 0.5 / change.lpNorm<Eigen::Infinity>()));
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
  return error;
}

// Evenly spread between the limits (additive recurrence).
Joints start_of(const Arm& arm, int i) noexcept {
  constexpr double kStride[] = {0.8567, 0.7339, 0.6287, 0.5386, 0.4614, 0.3953};
  Joints q;
  for (int a = 0; a < kAxes; ++a) {
    const Axis& axis = arm.axis(a);
    const double part = std::fmod(0.5 + i * kStride[a], 1.0);
    const double lower = axis.endless ? -kPi : std::max(axis.lower, -kPi);
    const double upper = axis.endless ? kPi : std::max(lower, std::min(axis.upper, lower + 2 * kPi));
    q[a] = lower + part * (upper - lower);
  }
  return q;
}

// Each angle by as many turns as bring it nearest to `near`; false if that is beyond the limits.
bool turn_back(const Arm& arm, const Joints& near, Joints& q) noexcept {
  for (int i = 0; i < kAxes; ++i) {
    const auto angle = turn_nearest(arm.axis(i), q[i], near[i]);
    if (!angle) {
      return false;
    }
    q[i] = *angle;
  }
  return true;
}

bool known(const Solutions& found, const Joints& q) noexcept {
  constexpr double kSame = 1e-4;  // rad
  for (int i = 0; i < found.count; ++i) {
    const Joints away = found.list[static_cast<std::size_t>(i)].q - q;
    if (away.unaryExpr([](double v) { return std::remainder(v, 2 * kPi); }).cwiseAbs().maxCoeff() < kSame) {
      return true;
    }
  }
  return false;
}

}  // namespace

NumericSolution solve_numerically(const Arm& arm, const Pose& pose, const Joints& near) noexcept {
  Joints q = near;
  const double error = descend(arm, pose, {}, q);
  const bool at_limit = arm.beyond_limits(q, -1e-9) >= 0;
  const Reach missed = at_limit ? Reach::JointLimit : Reach::OutOfReach;
  return {error < kGood * kGood ? Reach::Ok : missed, q};
}

Solutions search_numerically(const Arm& arm, const std::optional<Postures>& postures, const Pose& pose,
                             const Joints& near, const Starts& starts) noexcept {
  constexpr int kFew = 40;  // steps: a start that is no use shows it early
  Solutions found;
  for (int i = 0; i < starts.least || (found.count == 0 && i < starts.most); ++i) {
    Joints q = i == 0 ? near : start_of(arm, i);
    // A way that leaves the limits often comes back into them a turn later, and one along a limit may lead round it.
    if (descend(arm, pose, {kFew, i % 2 == 0}, q) > kClose * kClose) {
      continue;
    }
    if (!turn_back(arm, near, q)) {
      found.reach = found.count > 0 ? Reach::Ok : Reach::JointLimit;
    } else if (descend(arm, pose, {}, q) < kExact * kExact && !known(found, q)) {
      found.add(arm, q, postures ? postures->at(arm, q) : std::uint8_t{0}, near);
    }
  }
  return found;
}

}  // namespace indurop::robot
