// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/torque_control.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kSmooth = 0.03;    // s: smooths encoder steps, which are no accelerations
constexpr int kDelays = 5;          // the control is this many times slower than the drive's delay
constexpr double kStanding = 0.02;  // part of the velocity that counts as standstill
constexpr double kReached = 1 - 1e-9;
constexpr double kFaster = 0.1;    // part of the velocity by which the axis may exceed it
constexpr double kRampTime = 0.1;  // s, of a ramp that is not given

double towards(double from, double to, double step) noexcept {
  return from + std::clamp(to - from, -step, step);
}

}  // namespace

void TorqueControl::take(const Request& request) noexcept {
  request_ = request;
  if (phase_ == Phase::Off) {
    phase_ = Phase::Resting;
    asked_ = carried_ = torque_ = speed_ = 0;
    reached_ = false;
  }
}

void TorqueControl::off() noexcept {
  phase_ = Phase::Off;
  torque_ = 0;
  reached_ = false;
}

void TorqueControl::enter() noexcept {
  phase_ = Phase::Entering;
}

void TorqueControl::push(int late) noexcept {
  phase_ = Phase::Pushing;
  late_ = std::clamp(late, 1, kMostLate);
  given_.fill(0);
}

// An axis that comes free is accelerated by the torque increase until that is measured and corrected, which limits the
// ramp.
double TorqueControl::ramp(double smooth, double period) const noexcept {
  const double safe = kFaster * request_.velocity * load_.inertia / (late_ * period * smooth);
  const double quick = std::max(std::abs(request_.torque), std::abs(asked_)) / kRampTime;
  return std::min(safe, request_.ramp > 0 ? request_.ramp : quick);
}

// The torque is the estimated torque of the obstacle plus the torque that accelerates the axis towards its velocity;
// never more than requested. So a free axis keeps its velocity, and one that stands against an obstacle pushes with the
// full torque. The obstacle's torque is what the drive gave beyond what the inertia took, as in a disturbance observer.
void TorqueControl::step(double speed, double period) noexcept {
  const bool held = !(override_ > 0);
  const double smooth = std::max(kSmooth, kDelays * late_ * period);
  const double step = ramp(smooth, period) * period;
  asked_ = towards(asked_, held ? 0 : request_.torque, step);
  const double way = asked_ != 0 ? std::copysign(1, asked_) : std::copysign(1, request_.torque);
  const double most = std::abs(asked_);
  const double seen = given_[static_cast<std::size_t>(late_)] - load_.inertia * (speed - speed_) / period;
  carried_ += std::min(1.0, period / smooth) * (seen - carried_);
  speed_ = speed;
  const double velocity = request_.velocity * override_;
  const bool stands = std::abs(speed) < kStanding * velocity;
  double carried = std::clamp(way * carried_, -most, most);
  carried = stands ? std::min(carried + step, most) : carried;
  carried_ = way * carried;
  const double missing = (velocity - way * speed) / smooth;
  const double acceleration = std::clamp(missing, -request_.acceleration, request_.acceleration);
  const double grown = std::min(most, std::max(0.0, way * torque_) + step);
  const double wanted = std::clamp(carried + load_.inertia * acceleration, -most, grown);
  std::copy_backward(given_.begin(), given_.end() - 1, given_.end());
  torque_ = std::clamp(way * wanted, std::min(load_.lower, 0.0), std::max(load_.upper, 0.0));
  given_[0] = torque_;
  reached_ = asked_ == request_.torque && way * torque_ >= most * kReached;
}

}  // namespace indurop::robot
