// SPDX-License-Identifier: Apache-2.0
// Checks whether the torques of a motion are within the limits of the axes, and how much slower it has to be for that.
// Torque for accelerations falls with the square of the motion's duration; torque against gravity does not.

#pragma once

#include <array>
#include <span>

#include "control/robot/kinematics/dynamics.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

// The smallest factor of slowing down that is sufficient for all checked places of a path.
class EffortBound {
 public:
  // How a path is followed at a place: the square of the speed along it, and the acceleration.
  struct Pace {
    double square = 1;
    double acceleration = 0;
  };

  // A motion that would have to be slower than this part of its speed is rejected.
  static constexpr double kSlowest = 0.02;
  // Checks a place. `first` and `second` are derivatives by the place on the path. All functions of this class are
  // real-time safe.
  void look(const Dynamics& dynamics, const Joints& q, const Joints& first, const Joints& second,
            std::span<const Pace> paces, double slowest = kSlowest) noexcept;
  // Returns the factor on the duration of the motion.
  [[nodiscard]] double slower() const noexcept { return 1 / part_; }
  // Returns Torque if no slower motion is possible.
  [[nodiscard]] const Fault& fault() const noexcept { return fault_; }

 private:
  double part_ = 1;  // of the speed
  Fault fault_;
};

// Checks a planned motion and slows it down as far as necessary.
class EffortLook {
 public:
  EffortLook(const Places& places, const JointLimits& joints) noexcept : places_(places), joints_(joints) {}

  // Begins with a segment. If it is done() then, there is nothing to check.
  void begin(const Segment& segment) noexcept;
  [[nodiscard]] bool done() const noexcept { return way_ == Way::None; }
  // Checks one more place. `may_refuse`: rejects a motion that would have to be far slower, which else becomes as slow
  // as that. Errors: Torque.
  Fault look(Segment& segment, bool may_refuse) noexcept;

 private:
  // How a segment may be followed: joint timing at or below full pace, at one speed, or by its timing.
  enum class Way { None, JointsAtOnce, JointsLeaving, JointsStraight, Speed, Timing };
  static constexpr std::size_t kPaces = 6;
  using Paces = std::array<EffortBound::Pace, kPaces>;

  void begin_way(const Segment& segment, Way way) noexcept;
  void next_way(Segment& segment) noexcept;
  void check_joints(const Segment& segment, double part) noexcept;
  void check_tool(const Segment& segment, double part) noexcept;
  static Paces changing(const PaceLimits& limits, double most) noexcept;
  static Paces at_one_speed(const LineLimits& limits) noexcept;

  const Places& places_;
  const JointLimits& joints_;
  double slowest_ = EffortBound::kSlowest;
  EffortBound bound_;
  Way way_ = Way::None;
  JointTiming joint_timing_;
  Paces paces_;
  int next_ = 0;
  int count_ = 0;
  std::array<Joints, 3> seen_;
};

// Returns Torque if the arm cannot move along a path however slowly it does, given `count` + 1 equally spaced places;
// `place` is then where.
Fault check_holding(const Dynamics& dynamics, const Joints* places, int count, int& place) noexcept;

// Limits a path at one speed by torques, checked at `count` + 1 equally spaced places. Returns false if that is
// impossible.
bool slow_down(const Dynamics& dynamics, const Joints* places, int count, double spacing, LineLimits& limits) noexcept;

}  // namespace indurop::robot
