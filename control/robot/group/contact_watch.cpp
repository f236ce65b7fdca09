// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/contact_watch.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kSmooth = 0.03;  // s: steps of the encoder are not motions of the arm
constexpr double kWaking = 0.2;   // s until brakes are open and drives hold the arm
constexpr int kSure = 3;          // periods
constexpr double kSlow = 0.01;    // rad/s or m/s: below this, dry friction may act in either direction

}  // namespace

void ContactWatch::rest() noexcept {
  known_ = 0;
  awake_ = 0;
  residual_.setZero();
  allowed_ = limit_;
  beyond_.fill(0);
}

void ContactWatch::release() noexcept {
  for (Eigen::Index i = 0; i < limit_.size(); ++i) {
    const double pushed = std::abs(residual_[i]);
    allowed_[i] = pushed > limit_[i] / 2 ? pushed + limit_[i] : limit_[i];
  }
  beyond_.fill(0);
}

double ContactWatch::allowed(const Dynamics& dynamics, const Joints& velocity, Eigen::Index axis) const noexcept {
  const double held = std::abs(velocity[axis]) < kSlow ? dynamics.friction().dry[axis] : 0;
  return allowed_[axis] + held;
}

int ContactWatch::step(const Dynamics& dynamics, const Joints& q, const Joints& torque, double period) noexcept {
  // Motion is computed for the instant between the last two periods.
  const Joints given = (torque + torque_) / 2;
  torque_ = torque;
  q_ = {q, q_[0], q_[1]};
  awake_ += period;
  if (++known_ < 3 || awake_ < kWaking) {
    known_ = std::min(known_, 3);
    return -1;
  }
  known_ = 3;
  const Joints velocity = (q_[0] - q_[2]) / (2 * period);
  const Joints acceleration = (q_[0] - 2 * q_[1] + q_[2]) / (period * period);
  const Joints needed = dynamics.torques(q_[1], velocity, acceleration) + dynamics.friction(velocity);
  residual_ += std::min(1.0, period / kSmooth) * (given - needed - residual_);
  int first = -1;
  for (Eigen::Index i = 0; i < limit_.size(); ++i) {
    int& beyond = beyond_[static_cast<std::size_t>(i)];
    const double pushed = std::abs(residual_[i]);
    beyond = limit_[i] > 0 && pushed > allowed(dynamics, velocity, i) ? std::min(beyond + 1, kSure) : 0;
    if (pushed < limit_[i] / 2) {
      allowed_[i] = limit_[i];
    }
    first = first < 0 && beyond >= kSure ? static_cast<int>(i) : first;
  }
  return first;
}

}  // namespace indurop::robot
