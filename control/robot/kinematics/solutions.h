// SPDX-License-Identifier: Apache-2.0
// The result of inverse kinematics: joint angles for a pose of the tool, or what prevents a solution.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "control/robot/kinematics/arm.h"
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

// One way to hold the tool at a pose. The bits of `posture` distinguish the ways.
struct Solution {
  static constexpr std::uint8_t kShoulder = 1;  // arm reaches over its back
  static constexpr std::uint8_t kElbow = 2;     // the other elbow position
  static constexpr std::uint8_t kWrist = 4;     // wrist turned over
  Joints q = Joints::Zero();
  std::uint8_t posture = 0;
};

enum class Reach { Ok, OutOfReach, JointLimit };
// The error of a motion that cannot be reached for this reason. Real-time safe.
[[nodiscard]] ErrorCode code_of(Reach reach) noexcept;

struct Solutions {
  std::array<Solution, 16> list;
  int count = 0;
  Reach reach = Reach::OutOfReach;  // Ok if count > 0; JointLimit: only the joint limits prevent a solution

  // Adds these angles, each shifted by the full turns that bring it nearest to `near`, if that is within the limits.
  // Real-time safe, like all functions of this struct.
  void add(const Arm& arm, const Joints& q, std::uint8_t posture, const Joints& near) noexcept;
  // The solution nearest to `near`; with `posture`, the nearest of that posture.
  [[nodiscard]] const Solution* nearest(const Joints& near, std::optional<std::uint8_t> posture) const noexcept;
};

// Collects the solutions that a closed form finds: all of them, or only those needed to know the nearest. Real-time
// safe.
class Gathered {
 public:
  enum class What { All, Nearest };
  Gathered(const Arm& arm, const Joints& near, What what) noexcept : arm_(arm), near_(near), what_(what) {}

  [[nodiscard]] const Arm& arm() const noexcept { return arm_; }
  [[nodiscard]] const Joints& near() const noexcept { return near_; }
  // A lower bound of the square of the distance of that angle of an axis from `near`.
  [[nodiscard]] double away(int axis, double angle) const noexcept;
  // Returns whether a solution with at least this distance may still be needed.
  [[nodiscard]] bool wants(double away) const noexcept { return what_ == What::All || away < nearest_ + kSlack; }
  void add(const Joints& q, std::uint8_t posture) noexcept;
  [[nodiscard]] const Solutions& found() const noexcept { return found_; }

 private:
  static constexpr double kSlack = 1e-7;  // tolerance of limits, for rounding
  const Arm& arm_;
  const Joints& near_;
  What what_;
  double nearest_ = HUGE_VAL;
  Solutions found_;
};

// The angles of the first axis that turn the arm's plane to a point: reaching forward, and over the back.
class FirstTurns {
 public:
  struct Turn {
    double angle = 0;
    std::uint8_t posture = 0;
  };
  // `point`, in a frame on the axis, must have the distance `offset` from it that the plane has. `front`: at joint
  // angles zero the arm reaches forward. If the point is on the axis, any angle is a solution: `near` is used. No
  // solution if the point is too close to the axis. The one nearer to `near` comes first.
  FirstTurns(const Eigen::Vector2d& point, double offset, bool front, double near) noexcept;
  [[nodiscard]] const Turn* begin() const noexcept { return turns_.data(); }
  [[nodiscard]] const Turn* end() const noexcept { return turns_.data() + count_; }

 private:
  std::array<Turn, 2> turns_{};
  std::size_t count_ = 0;
};

}  // namespace indurop::robot
