// SPDX-License-Identifier: Apache-2.0
// A motion of all joints from any state to rest: it ends as soon as the slowest joint can arrive, and the others arrive
// with it. Each joint keeps its own limits, so it is no straight line between joint angles.

#pragma once

#include <array>

#include "control/robot/kinematics/arm.h"
#include "control/robot/path/pace.h"

namespace indurop::robot {

struct JointState {
  Joints position = Joints::Zero();
  Joints velocity = Joints::Zero();
  Joints acceleration = Joints::Zero();
};

// The part of the joints' limits that a joint motion uses; the rest is left for changes of its pace.
struct JointShares {
  double acceleration = 1;
  double jerk = 1;
  // Shares of a motion that is followed at this pace: all of the limits at full pace, and also where the pace alone
  // leaves enough.
  static JointShares at(double pace) noexcept;
  // The highest pace at which changes of pace still have the share that lines leave them.
  [[nodiscard]] double fastest() const noexcept;
};

class JointTiming {
 public:
  // Plans from any state within the limits; speed or acceleration beyond them is reduced first. A joint that comes to
  // rest without being slowed down for the others may arrive before them. Real-time safe, like all functions of this
  // class.
  void plan(const JointState& from, const Joints& to, const JointLimits& limits) noexcept;
  [[nodiscard]] double duration() const noexcept { return duration_; }
  // `jerk`: if given, receives the jerk too; at a jump of the jerk the value after it.
  [[nodiscard]] JointState at(double time, Joints* jerk = nullptr) const noexcept;
  // Limits for changes of the pace at which the motion is followed, if it uses those shares of the limits.
  [[nodiscard]] PaceLimits pace_limits(const JointLimits& limits, const JointShares& shares) const noexcept;

  // The positions at which the joints come to rest if they brake at once.
  static Joints stopping(const JointState& from, const JointLimits& limits) noexcept;
  // Speeds that are reached if the accelerations are reduced to 0 at once.
  static Joints unloaded(const JointState& from, const JointLimits& limits) noexcept;
  // Time until the joints are within these accelerations, and their speeds within `most`.
  static double settling(const JointState& from, const JointLimits& limits, const Joints& most) noexcept;

 private:
  std::array<Profile, kAxes> axes_;
  double duration_ = 0;
};

// Limits of motions at this part of full speed.
JointLimits limits_for(const JointLimits& all, double speed, const JointShares& shares) noexcept;

}  // namespace indurop::robot
