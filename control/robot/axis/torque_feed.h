// SPDX-License-Identifier: Apache-2.0
// The torque feed-forward of a motion for the drives, without steps when the arm picks up or puts down a load.

#pragma once

#include <algorithm>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

class TorqueFeed {
 public:
  // The needed torque will change at the same position, because the load changes. Real-time safe, like all functions of
  // this class.
  void reweigh() noexcept { left_ = kTime; }
  // The drives have no power: the torque that is needed next applies at once.
  void rest() noexcept { left_ = 0; }
  // Computes the next period.
  const Joints& step(const Joints& needed, double period) noexcept {
    if (left_ >= kTime) {
      missing_ = torque_ - needed;
    }
    torque_ = needed + std::max(0.0, left_ / kTime) * missing_;
    left_ -= period;
    return torque_;
  }

 private:
  static constexpr double kTime = 0.1;  // s
  double left_ = 0;                     // until the full torque is commanded
  Joints torque_ = Joints::Zero();
  Joints missing_ = Joints::Zero();
};

}  // namespace indurop::robot
