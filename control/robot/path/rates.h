// SPDX-License-Identifier: Apache-2.0
// The rates at which joint angles change along a path, and the speed along the path that keeps the joints' limits.

#pragma once

#include "control/robot/kinematics/arm.h"
#include "control/robot/path/profile.h"

namespace indurop::robot {

// The part of the joints' accelerations and jerks that a path at constant speed may use to follow its bends, and the
// part of their jerks for bends while the speed changes; the rest is for changes of speed.
struct Shares {
  static constexpr double kBending = 0.75;
  static constexpr double kBendingJerk = 0.6;
  static constexpr double kMixedJerk = 0.2;
};

// Returns the limits of one axis, from 0. Real-time safe.
inline LineLimits limits_of_axis(const JointLimits& joints, int axis) noexcept {
  return {joints.velocity[axis], joints.acceleration[axis], joints.jerk[axis]};
}

// Absolute first, second and third derivatives, in rad per s at full speed.
struct Rates {
  Joints first = Joints::Zero();
  Joints second = Joints::Zero();
  Joints third = Joints::Zero();
};

// Limit of a quantity that is `part` of something; infinite if `part` is 0. Real-time safe, like all functions of this
// file.
double shared(double limit, double part) noexcept;
// Rates between places i and i + 1 of `count` + 1, by differences.
Rates rates_at(const Joints* places, int count, int i, double spacing) noexcept;
// Permitted speed along a path, at most `most`.
double velocity_for(const Rates& rates, const JointLimits& joints, double most) noexcept;
// Reduces acceleration and jerk to what a path that is followed with `limits.velocity` leaves for changes of speed.
void leave_for_changes(const Rates& rates, const JointLimits& joints, LineLimits& limits) noexcept;
// Speed of the fastest joint, as part of its limit.
double pace(const Rates& rates, const JointLimits& joints) noexcept;
// Returns whether a singular position, where `volume` is 0, may lie between places i and i + 1: extrapolated from
// before and after them, the volume falls to a third.
bool may_be_singular(const double* volume, int count, int i) noexcept;

// Limits of the speed along a path that keep the joints' limits, given the joint angles at `count` + 1 equally spaced
// places; at most `most`. A part of acceleration and jerk is reserved for changes of speed.
LineLimits limits_along(const Joints* places, int count, double spacing, const JointLimits& joints,
                        const LineLimits& most) noexcept;

}  // namespace indurop::robot
