// SPDX-License-Identifier: Apache-2.0
// A motion of all joints from any state to rest: it ends as soon as the slowest of them can be there, and the others
// arrive with it. Each keeps its own limits, so it is no straight line between joint angles.

#pragma once

#include <array>

#include "robot/arm.h"
#include "robot/pace.h"

namespace indurop::robot {

struct JointState {
  Joints position = Joints::Zero();
  Joints velocity = Joints::Zero();
  Joints acceleration = Joints::Zero();
};

// What a joint motion takes of the joints' limits; the rest is for changes of its pace.
struct JointShares {
  double acceleration = 1;
  double jerk = 1;
  // Of one that is to be followed at this pace: all at the full pace, and where the pace leaves enough by itself.
  static JointShares at(double pace) noexcept;
  // The pace at which changes of it still have what lines leave them.
  [[nodiscard]] double fastest() const noexcept;
};

class JointTiming {
 public:
  // Any state within the limits; more speed or acceleration than that is taken back first. A joint that comes to rest
  // without getting slower for the others may be there before them. Real-time safe, as all here.
  void plan(const JointState& from, const Joints& to, const JointLimits& limits) noexcept;
  [[nodiscard]] double duration() const noexcept { return duration_; }
  // `jerk`: is told too, behind a change of it.
  [[nodiscard]] JointState at(double time, Joints* jerk = nullptr) const noexcept;
  // Of changes of the pace at which it is followed, if it took those shares of the limits.
  [[nodiscard]] PaceLimits pace_limits(const JointLimits& limits, const JointShares& shares) const noexcept;

  // Where the joints come to rest if they brake at once.
  static Joints stopping(const JointState& from, const JointLimits& limits) noexcept;
  // How fast they get if their accelerations are taken back at once.
  static Joints unloaded(const JointState& from, const JointLimits& limits) noexcept;
  // How long it takes until they are within these accelerations, and within `most` of speed.
  static double settling(const JointState& from, const JointLimits& limits, const Joints& most) noexcept;

 private:
  std::array<Profile, kAxes> axes_;
  double duration_ = 0;
};

// Limits of motions at part of full speed.
JointLimits limits_for(const JointLimits& all, double speed, const JointShares& shares) noexcept;

}  // namespace indurop::robot
