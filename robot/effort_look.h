// SPDX-License-Identifier: Apache-2.0
// Whether the torques of a motion are within what the axes can give, and how much slower it has to be for that. Torque
// for accelerations falls with the square of the time that a motion takes; what holds the arm against gravity does not.

#pragma once

#include <array>
#include <span>

#include "robot/dynamics.h"
#include "robot/errors.h"
#include "robot/segment.h"

namespace indurop::robot {

// The least slowness that is enough at any number of places.
class EffortBound {
 public:
  // How a path is followed at a place: the square of the speed along it, and the acceleration.
  struct Pace {
    double square = 1;
    double acceleration = 0;
  };

  // `first` and `second` are derivatives by the place on the path. Real-time safe, as all here.
  void look(const Dynamics& dynamics, const Joints& q, const Joints& first, const Joints& second,
            std::span<const Pace> paces) noexcept;
  // How many times as long it has to take.
  [[nodiscard]] double slower() const noexcept { return 1 / part_; }
  // Torque: no slowness helps.
  [[nodiscard]] const Fault& fault() const noexcept { return fault_; }

 private:
  double part_ = 1;  // of the speed
  Fault fault_;
};

// Looks at a motion that was planned, and makes it as slow as it has to be.
class EffortLook {
 public:
  EffortLook(const Places& places, const JointLimits& joints) noexcept : places_(places), joints_(joints) {}

  // Nothing to do, if it is done() then.
  void begin(const Segment& segment) noexcept;
  [[nodiscard]] bool done() const noexcept { return way_ == Way::None; }
  // Looks at one place more. Errors: Torque.
  Fault look(Segment& segment) noexcept;

 private:
  // What a segment may be followed by: a timing of joints at the full pace or below, at one speed, by its timing.
  enum class Way { None, JointsAtOnce, JointsLeaving, JointsStraight, Speed, Timing };
  static constexpr std::size_t kPaces = 6;
  using Paces = std::array<EffortBound::Pace, kPaces>;

  void begin_way(const Segment& segment, Way way) noexcept;
  void next_way(Segment& segment) noexcept;
  void look_at_joints(const Segment& segment, double part) noexcept;
  void look_at_tool(const Segment& segment, double part) noexcept;
  static Paces changing(const PaceLimits& limits, double most) noexcept;
  static Paces at_one_speed(const LineLimits& limits) noexcept;

  const Places& places_;
  const JointLimits& joints_;
  EffortBound bound_;
  Way way_ = Way::None;
  JointTiming joint_timing_;
  Paces paces_;
  int next_ = 0;
  int count_ = 0;
  std::array<Joints, 3> seen_;
};

// What a path at one speed has to be, looked at in `count` + 1 equally spaced places. False: it cannot be.
bool slow_down(const Dynamics& dynamics, const Joints* places, int count, double spacing, LineLimits& limits) noexcept;

}  // namespace indurop::robot
