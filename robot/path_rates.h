// SPDX-License-Identifier: Apache-2.0
// How fast joint angles change along a path, and what speed along it that leaves within the joints' limits.

#pragma once

#include "robot/arm.h"
#include "robot/profile.h"

namespace indurop::robot {

// What a path with one speed may use of joints' accelerations and jerks to keep to its bends, and of their jerks for
// bends while the speed changes; the rest is for changes of speed.
struct Shares {
  static constexpr double kBending = 0.75;
  static constexpr double kBendingJerk = 0.6;
  static constexpr double kMixedJerk = 0.2;
};

// In rad per s at full speed: absolute first, second and third derivatives.
struct Rates {
  Joints first = Joints::Zero();
  Joints second = Joints::Zero();
  Joints third = Joints::Zero();
};

// A limit of what is `part` of something; infinite of nothing. Real-time safe, as all here.
double shared(double limit, double part) noexcept;
// Between places i and i + 1 of `count` + 1, by differences.
Rates rates_at(const Joints* places, int count, int i, double spacing) noexcept;
// The speed along a path, not above `most`.
double velocity_for(const Rates& rates, const JointLimits& joints, double most) noexcept;
// Lowers acceleration and jerk to what a path that is followed with `limits.velocity` leaves for changes of it.
void leave_for_changes(const Rates& rates, const JointLimits& joints, LineLimits& limits) noexcept;
// Of the fastest joint, as part of its limit.
double pace(const Rates& rates, const JointLimits& joints) noexcept;
// Whether a singular position, where `volume` is 0, may lie between places i and i + 1: if it goes on as before and
// behind them, it comes down to a third.
bool may_be_singular(const double* volume, int count, int i) noexcept;

// Limits of the speed along a path that keep the joints' limits, given the joint angles at `count` + 1 equally spaced
// places; not above `most`. A part of acceleration and jerk is kept for changes of speed.
LineLimits limits_along(const Joints* places, int count, double spacing, const JointLimits& joints,
                        const LineLimits& most) noexcept;

}  // namespace indurop::robot
