// SPDX-License-Identifier: Apache-2.0
// The speed of the tool's tip and of the arm's end: both are limited where people are near (ISO 10218-1, reduced speed:
// 250 mm/s). Axes may move against each other, so that the tip is slow only while all of them move: near a stretched
// elbow it is much faster if one of them stops. A planned speed takes that into account.

#pragma once

#include <algorithm>

#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

inline constexpr double kReducedSpeed = 0.25;  // m/s

class TipSpeed {
 public:
  explicit TipSpeed(const Arm& arm) noexcept : arm_(&arm) {}

  // Begins at these joint angles. Real-time safe, like all functions of this class.
  void begin(const Joints& q) noexcept {
    at_ = where(q);
    moved_ = farthest_ = 0;
  }
  // Adds the next joint angles of the motion.
  void note(const Joints& q) noexcept {
    const Place next = where(q);
    const Vec3 tip = next.tip - at_.tip;
    const Vec3 end = next.end - at_.end;
    moved_ = std::max({moved_, tip.norm(), end.norm()});
    farthest_ = std::max(farthest_, moved_);
    const Vec3 lever = (next.end - next.tip + at_.end - at_.tip) / 2;
    for (int i = 0; i < arm_->count(); ++i) {
      const Twist part = (next.q[i] - at_.q[i]) / 2 * (next.rates.col(i) + at_.rates.col(i));
      const Vec3 of_tip = part.head<3>();
      const Vec3 of_end = of_tip + part.tail<3>().cross(lever);
      farthest_ = std::max({farthest_, of_tip.norm(), of_end.norm(), (tip - of_tip).norm(), (end - of_end).norm()});
    }
    at_ = next;
  }
  // Continues from these joint angles; the motion up to them is not counted.
  void go_on_from(const Joints& q) noexcept { at_ = where(q); }
  // m that the tip or the arm's end, whichever is faster, moves at most from one step to the next.
  [[nodiscard]] double moved() const noexcept { return moved_; }
  // The same, also if any one axis, or all others, had stopped during the step.
  [[nodiscard]] double farthest() const noexcept { return farthest_; }

 private:
  struct Place {
    Joints q = Joints::Zero();
    Vec3 tip = Vec3::Zero(), end = Vec3::Zero();
    Jacobian rates = Jacobian::Zero();  // of the tip
  };
  [[nodiscard]] Place where(const Joints& q) const noexcept {
    Pose tool;
    const Jacobian rates = arm_->jacobian(q, tool);
    return {q, tool.position, arm_->end_of(tool), rates};
  }

  const Arm* arm_;
  Place at_;
  double moved_ = 0;
  double farthest_ = 0;
};

}  // namespace indurop::robot
