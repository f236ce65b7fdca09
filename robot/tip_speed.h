// SPDX-License-Identifier: Apache-2.0
// How fast the tool's tip and the arm's end are: the speed of both counts where people are near (ISO 10218-1, reduced
// speed: 250 mm/s).

#pragma once

#include <algorithm>

#include "robot/arm.h"

namespace indurop::robot {

inline constexpr double kReducedSpeed = 0.25;  // m/s

class TipSpeed {
 public:
  explicit TipSpeed(const Arm& arm) noexcept : arm_(&arm) {}

  // Begins at these joint angles. Real-time safe, as all here.
  void begin(const Joints& q) noexcept {
    at_ = where(q);
    farthest_ = 0;
  }
  // The next ones on the way.
  void note(const Joints& q) noexcept {
    const Place next = where(q);
    farthest_ = std::max({farthest_, (next.tip - at_.tip).norm(), (next.end - at_.end).norm()});
    at_ = next;
  }
  // m that the faster of both has gone at most, from one to the next.
  [[nodiscard]] double farthest() const noexcept { return farthest_; }

 private:
  struct Place {
    Vec3 tip = Vec3::Zero(), end = Vec3::Zero();
  };
  [[nodiscard]] Place where(const Joints& q) const noexcept {
    const Pose tip = arm_->forward(q);
    return {tip.position, arm_->end_of(tip)};
  }

  const Arm* arm_;
  Place at_;
  double farthest_ = 0;
};

}  // namespace indurop::robot
