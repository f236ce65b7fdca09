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
  // Adds the next joint angles of the motion. If axes turn the workpiece, the speed over it and that in the world both
  // count.
  void note(const Joints& q) noexcept {
    const Place next = where(q);
    moved_ = 0;
    note(at_, next, at_.base, next.base);
    if (arm_->world_joint() > 0) {
      note(at_, next, at_.world, next.world);
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
  // Seen from the base or from the world.
  struct View {
    Vec3 tip = Vec3::Zero(), end = Vec3::Zero();
    Jacobian rates = Jacobian::Zero();  // of the tip
  };
  struct Place {
    Joints q = Joints::Zero();
    View base, world;  // the latter only if it is another one
  };

  void note(const Place& last, const Place& next, const View& before, const View& after) noexcept {
    const Vec3 tip = after.tip - before.tip;
    const Vec3 end = after.end - before.end;
    moved_ = std::max({moved_, tip.norm(), end.norm()});
    farthest_ = std::max(farthest_, moved_);
    const Vec3 lever = (after.end - after.tip + before.end - before.tip) / 2;
    for (int i = 0; i < arm_->count(); ++i) {
      const Twist part = (next.q[i] - last.q[i]) / 2 * (after.rates.col(i) + before.rates.col(i));
      const Vec3 of_tip = part.head<3>();
      const Vec3 of_end = of_tip + part.tail<3>().cross(lever);
      farthest_ = std::max({farthest_, of_tip.norm(), of_end.norm(), (tip - of_tip).norm(), (end - of_end).norm()});
    }
  }
  [[nodiscard]] Place where(const Joints& q) const noexcept {
    Pose tool;
    Place place;
    place.q = q;
    place.base.rates = arm_->jacobian(q, tool);
    place.base.tip = tool.position;
    place.base.end = arm_->end_of(tool);
    if (arm_->world_joint() > 0) {
      place.world = in_world(place);
    }
    return place;
  }
  [[nodiscard]] View in_world(const Place& place) const noexcept {
    const ChainFrame world = arm_->world(place.q);
    const Mat3 back = world.turn.transpose();
    View view{back * (place.base.tip - world.shift), back * (place.base.end - world.shift), place.base.rates};
    view.rates.topRows<3>() = back * place.base.rates.topRows<3>();
    view.rates.bottomRows<3>() = back * place.base.rates.bottomRows<3>();
    for (int i = 0; i < arm_->count(); ++i) {
      if (arm_->moves_workpiece(i)) {
        view.rates.col(i).setZero();
      }
    }
    return view;
  }

  const Arm* arm_;
  Place at_;
  double moved_ = 0;
  double farthest_ = 0;
};

}  // namespace indurop::robot
