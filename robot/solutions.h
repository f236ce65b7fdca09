// SPDX-License-Identifier: Apache-2.0
// What inverse kinematics answers with: joint angles for a pose of the tool, and what is in the way where there are
// none.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "robot/arm.h"

namespace indurop::robot {

// One way of holding the tool at a pose. The bits of `posture` tell the ways apart.
struct Solution {
  static constexpr std::uint8_t kShoulder = 1;  // arm reaches over its back
  static constexpr std::uint8_t kElbow = 2;     // the other elbow
  static constexpr std::uint8_t kWrist = 4;     // wrist turned over
  Joints q = Joints::Zero();
  std::uint8_t posture = 0;
};

enum class Reach { Ok, OutOfReach, JointLimit };

struct Solutions {
  std::array<Solution, 16> list;
  int count = 0;
  Reach reach = Reach::OutOfReach;  // Ok if count > 0; JointLimit: only the limits are in the way

  // These angles, each by as many turns as bring it nearest to `near`, if that is within the limits. Real-time safe, as
  // all here.
  void add(const Arm& arm, const Joints& q, std::uint8_t posture, const Joints& near) noexcept;
  // The one nearest to `near`, with `posture` only of those.
  [[nodiscard]] const Solution* nearest(const Joints& near, std::optional<std::uint8_t> posture) const noexcept;
};

// What a closed form finds on its way through all solutions: all of them, or no more than it takes to know the nearest.
// Real-time safe.
class Gathered {
 public:
  enum class What { All, Nearest };
  Gathered(const Arm& arm, const Joints& near, What what) noexcept : arm_(arm), near_(near), what_(what) {}

  [[nodiscard]] const Arm& arm() const noexcept { return arm_; }
  [[nodiscard]] const Joints& near() const noexcept { return near_; }
  // The square of how far that angle of an axis is from `near` at least.
  [[nodiscard]] double away(int axis, double angle) const noexcept;
  // Whether what is so far away at least may still be wanted.
  [[nodiscard]] bool wants(double away) const noexcept { return what_ == What::All || away < nearest_ + kSlack; }
  void add(const Joints& q, std::uint8_t posture) noexcept;
  [[nodiscard]] const Solutions& found() const noexcept { return found_; }

 private:
  static constexpr double kSlack = 1e-7;  // of limits, which may be missed by rounding
  const Arm& arm_;
  const Joints& near_;
  What what_;
  double nearest_ = HUGE_VAL;
  Solutions found_;
};

// The angles of the first axis that bring the arm's plane to a point, over the shoulder and over the back.
class FirstTurns {
 public:
  struct Turn {
    double angle = 0;
    std::uint8_t posture = 0;
  };
  // `point`, in a frame on the axis, has to stand off by `offset` as the plane does. `front`: at joint angles zero the
  // arm reaches over its shoulder. Where the point is on the axis any angle will do: `near`. None if it is too near.
  // The one nearer to `near` comes first.
  FirstTurns(const Eigen::Vector2d& point, double offset, bool front, double near) noexcept;
  [[nodiscard]] const Turn* begin() const noexcept { return turns_.data(); }
  [[nodiscard]] const Turn* end() const noexcept { return turns_.data() + count_; }

 private:
  std::array<Turn, 2> turns_{};
  std::size_t count_ = 0;
};

}  // namespace indurop::robot
