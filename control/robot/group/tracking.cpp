// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/tracking.h"

namespace indurop::robot {

void Tracking::set(const Carrier& carrier, const BeltEstimator& belt) noexcept {
  carrier_ = carrier;
  known_ = true;
  zero_ = belt.now().position;
  has_lag_ = false;
}

LineState Tracking::seen(const LineState& belt) const noexcept {
  return {scale() * (belt.position - zero_), scale() * belt.velocity, scale() * belt.acceleration};
}

Pose Tracking::carried(const Carrier& carrier, double by, const Pose& pose) noexcept {
  const Quat& axes = carrier.origin.orientation;
  if (!carrier.turns) {
    return {pose.position + by * (axes * Vec3::UnitX()), pose.orientation};
  }
  const Quat turn(Eigen::AngleAxisd(by, axes * Vec3::UnitZ()));
  const Vec3& middle = carrier.origin.position;
  return {middle + turn * (pose.position - middle), (turn * pose.orientation).normalized()};
}

void Tracking::join(const BeltEstimator& belt, const LineLimits& way, const LineLimits& most) noexcept {
  const LineState now = gate_.state();
  const double from = phase_ == Phase::Off ? seen(belt.before()).position : now.position;
  const bool fresh = phase_ == Phase::Off;
  SetPointGate gate({}, most, period_);
  gate.stand(from);
  if (!fresh) {
    // Initializes the new gate with the present motion: two periods of it.
    const double before = from - period_ * now.velocity;
    gate.stand(before - period_ * (now.velocity - period_ * now.acceleration));
    gate.pass(before, HUGE_VAL);
    gate.pass(from, HUGE_VAL);
  }
  gate_ = gate;
  tracked_ = carrier_;
  anchor_ = fresh ? from : anchor_;
  coupling_.engage({}, way, most, gate_.state());
  if (has_lag_) {
    coupling_.shift(lag_, way);
  }
  phase_ = Phase::Joining;
}

void Tracking::leave(const LineLimits& way, bool stays) noexcept {
  has_lag_ = has_lag_ && stays;
  if (!on() || leaves()) {
    return;
  }
  const LineState& now = gate_.state();
  to_rest_ =
      Profile::to_velocity({now.position, now.velocity + now.acceleration * period_ / 2, now.acceleration}, 0, way);
  time_ = 0;
  phase_ = Phase::Leaving;
}

void Tracking::drop() noexcept {
  phase_ = Phase::Off;
  has_lag_ = false;
}

ErrorCode Tracking::step(const BeltEstimator& belt) noexcept {
  if (!on()) {
    return ErrorCode::Ok;
  }
  if (leaves()) {
    const double before = time_;
    time_ += period_;
    if (before < to_rest_.duration()) {
      gate_.pass(to_rest_.at(std::min(time_, to_rest_.duration())).position, 1);
    } else {
      gate_.stand(place());
    }
    return ErrorCode::Ok;
  }
  const AxisCoupling::Master master{seen(belt.before()), seen(belt.now()).position};
  if (const ErrorCode code = coupling_.step(master, gate_, period_); code != ErrorCode::Ok) {
    return code;
  }
  gate_.pass(coupling_.state().position, 1);
  if (coupling_.synced()) {
    phase_ = Phase::Synchronized;
    lag_ = has_lag_ ? lag_ : place() - master.now;
    has_lag_ = true;
  }
  return ErrorCode::Ok;
}

}  // namespace indurop::robot
