// SPDX-License-Identifier: Apache-2.0
// What inverse kinematics answers with: joint angles for a pose of the tool, and what is in the way where there are
// none.

#pragma once

#include <array>
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

// The angles of the first axis that bring the arm's plane to a point, over the shoulder and over the back.
class FirstTurns {
 public:
  struct Turn {
    double angle = 0;
    std::uint8_t posture = 0;
  };
  // `point`, in a frame on the axis, has to stand off by `offset` as the plane does. `front`: at joint angles zero the
  // arm reaches over its shoulder. Where the point is on the axis any angle will do: `near`. None if it is too near.
  FirstTurns(const Eigen::Vector2d& point, double offset, bool front, double near) noexcept;
  [[nodiscard]] const Turn* begin() const noexcept { return turns_.data(); }
  [[nodiscard]] const Turn* end() const noexcept { return turns_.data() + count_; }

 private:
  std::array<Turn, 2> turns_{};
  std::size_t count_ = 0;
};

}  // namespace indurop::robot
