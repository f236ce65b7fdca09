// SPDX-License-Identifier: Apache-2.0
// From a command to a path that is known to work: geometry first, then a look at places all along it for reach, joint
// limits and singular positions, a few at a time so that a tick stays short.

#pragma once

#include <array>

#include "robot/errors.h"
#include "robot/segment.h"

namespace indurop::robot {

// How fast joint angles change along a path, in rad per s at full speed: absolute first, second and third derivatives.
struct Rates {
  Joints first = Joints::Zero();
  Joints second = Joints::Zero();
  Joints third = Joints::Zero();
};

class Planner {
 public:
  // Of a joint's acceleration, at least, in a blend; the rest goes into keeping to the bend.
  static constexpr double kShareOfBraking = 0.25;

  Planner(const Places& places, const JointLimits& joints, const ToolLimits& tool) noexcept
      : places_(places), joints_(joints), tool_(tool) {}

  // Begins with a motion that starts at `from`. Real-time safe, as all here. Errors: Value, Unreachable,
  // JointLimit, Circle.
  Fault begin(const MoveCommand& command, const Joints& from) noexcept;
  // Looks at up to `places` more places of it; done() then says whether that was all. Errors: Unreachable, JointLimit,
  // Singular.
  Fault check(int places) noexcept;
  [[nodiscard]] bool done() const noexcept { return next_ > count_ && windows_ == 0; }
  // Complete when done().
  [[nodiscard]] const Segment& segment() const noexcept { return segment_; }

  // How `first` goes over into `second` with first.zone; zone 0 in the result if it cannot, or if
  // stopping at the corner is faster.
  [[nodiscard]] Blend blend(const Segment& first, const Segment& second) const noexcept;
  // Whether the joints may get from one place to the other in that time. Errors: JointLimit, Speed.
  [[nodiscard]] Fault allowed(const Joints& from, const Joints& to, double seconds) const noexcept;
  [[nodiscard]] const JointLimits& joint_limits() const noexcept { return joints_; }

 private:
  static constexpr int kMost = 128;
  using Samples = std::array<Joints, kMost + 1>;

  Fault resolve(const Target& target, const Joints& near, Joints& joints, Pose& pose) const noexcept;
  Fault check_next() noexcept;
  Fault look_closer() noexcept;
  [[nodiscard]] double volume(const Joints& q) const noexcept;
  void choose_windows(const Joints* places, const double* volumes, int count, double from, double spacing,
                      int depth) noexcept;
  void note(const Rates& rates) noexcept;
  Fault make_circle(const Vec3& mid) noexcept;
  void measure_joint_motion(double speed) noexcept;
  void measure_tool_motion(const MoveCommand& command) noexcept;

  const Places& places_;
  JointLimits joints_;
  ToolLimits tool_;
  Segment segment_;
  Samples samples_{};
  std::array<double, kMost + 1> volumes_{};
  int count_ = 0;  // places after the first
  int next_ = 1;
  // Stretches that are looked at closer before the path is known.
  struct Window {
    double from = 0;
    double length = 0;
    Joints start;
    Joints end;
    int depth = 0;
  };
  static constexpr int kParts = 8;  // of a stretch
  std::array<Window, 256> window_{};
  int windows_ = 0;
  std::array<Rates, std::size_t{3} * kMost> rates_{};
  int noted_ = 0;
  double wanted_ = 1;  // part of full speed, before the joints were asked
};

// Limits of the speed along a path that keep the joints' limits, given the joint angles at `count` + 1 equally spaced
// places; not above `most`. A part of acceleration and jerk is kept for changes of speed.
LineLimits limits_along(const Joints* places, int count, double spacing, const JointLimits& joints,
                        const LineLimits& most) noexcept;

}  // namespace indurop::robot
