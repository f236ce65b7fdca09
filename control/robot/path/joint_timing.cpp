// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/joint_timing.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

LineState of(const JointState& state, int axis) noexcept {
  return {state.position[axis], state.velocity[axis], state.acceleration[axis]};
}

LineLimits of(const JointLimits& limits, int axis) noexcept {
  return {limits.velocity[axis], limits.acceleration[axis], limits.jerk[axis]};
}

}  // namespace

// A joint that arrives early may wait there for the others, so no joint delays another by more than its own duration.
void JointTiming::plan(const JointState& from, const Joints& to, const JointLimits& limits) noexcept {
  duration_ = 0;
  for (int i = 0; i < kAxes; ++i) {
    const LineState start = of(from, i);
    Profile& axis = axes_[static_cast<std::size_t>(i)];
    const bool there = start.position == to[i] && start.velocity == 0 && start.acceleration == 0;
    axis = there ? Profile::coast(start) : Profile::to_rest(start, to[i], of(limits, i));
    duration_ = std::max(duration_, axis.duration());
  }
  const double together = duration_;
  for (int i = 0; i < kAxes; ++i) {
    Profile& axis = axes_[static_cast<std::size_t>(i)];
    if (axis.duration() > 0) {
      axis = axis.slower(of(limits, i), together);
    }
    duration_ = std::max(duration_, axis.duration());  // equal except for rounding
  }
}

JointState JointTiming::at(double time, Joints* jerk) const noexcept {
  JointState state;
  for (int i = 0; i < kAxes; ++i) {
    const LineState axis = axes_[static_cast<std::size_t>(i)].at(time);
    state.position[i] = axis.position;
    state.velocity[i] = axis.velocity;
    state.acceleration[i] = axis.acceleration;
    if (jerk != nullptr) {
      (*jerk)[i] = axes_[static_cast<std::size_t>(i)].jerk_at(time);
    }
  }
  return state;
}

PaceLimits JointTiming::pace_limits(const JointLimits& limits, const JointShares& shares) const noexcept {
  PaceLimits pace;
  pace.acceleration_share = shares.acceleration;
  pace.jerk_share = shares.jerk;
  for (int i = 0; i < kAxes; ++i) {
    const LineState peak = axes_[static_cast<std::size_t>(i)].peak();
    pace.acceleration = std::min(pace.acceleration, shared(limits.acceleration[i], peak.velocity));
    pace.mixed = std::min(pace.mixed, shared(limits.jerk[i], peak.acceleration));
    pace.jerk = std::min(pace.jerk, shared(limits.jerk[i], peak.velocity));
  }
  return pace;
}

Joints JointTiming::stopping(const JointState& from, const JointLimits& limits) noexcept {
  Joints places = from.position;
  for (int i = 0; i < kAxes; ++i) {
    places[i] += ramp(of(from, i), 0, of(limits, i)).distance;
  }
  return places;
}

Joints JointTiming::unloaded(const JointState& from, const JointLimits& limits) noexcept {
  const Joints& a = from.acceleration;
  return from.velocity + a.cwiseProduct(a.cwiseAbs()).cwiseQuotient(2 * limits.jerk);
}

double JointTiming::settling(const JointState& from, const JointLimits& limits, const Joints& most) noexcept {
  double time = (from.acceleration.cwiseAbs() - limits.acceleration).cwiseQuotient(limits.jerk).maxCoeff();
  const Joints speed = unloaded(from, limits);
  for (int i = 0; i < kAxes; ++i) {
    if (std::abs(speed[i]) > most[i]) {
      time = std::max(time, ramp(of(from, i), std::copysign(most[i], speed[i]), of(limits, i)).duration());
    }
  }
  return time;
}

// Uses less of the limits than lines do, so that a hold begins at once; this costs nothing while nothing disturbs the
// motion.
JointShares JointShares::at(double pace) noexcept {
  constexpr JointShares kLeaving{0.8, 0.6};
  if (pace >= 1) {
    return {};
  }
  const double square = pace * pace;
  return {std::min(1.0, kLeaving.acceleration / std::max(square, 1e-6)),
          std::min(1.0, kLeaving.jerk / std::max(square * pace, 1e-6))};
}

double JointShares::fastest() const noexcept {
  return std::min({1.0, std::sqrt(TimingShares::kAcceleration / acceleration), std::cbrt(TimingShares::kJerk / jerk)});
}

JointLimits limits_for(const JointLimits& all, double speed, const JointShares& shares) noexcept {
  return {speed * all.velocity, shares.acceleration * all.acceleration, shares.jerk * all.jerk};
}

}  // namespace indurop::robot
