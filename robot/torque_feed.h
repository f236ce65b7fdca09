// SPDX-License-Identifier: Apache-2.0
// What drives are told of the torque that a motion needs, without steps where the arm takes or lays down a load.

#pragma once

#include <algorithm>

#include "robot/geometry.h"

namespace indurop::robot {

class TorqueFeed {
 public:
  // What is needed will be another's, at the same place. Real-time safe, as all here.
  void reweigh() noexcept { left_ = kTime; }
  // The drives have no power: what is needed next counts at once.
  void rest() noexcept { left_ = 0; }
  // The next period.
  const Joints& step(const Joints& needed, double period) noexcept {
    if (left_ >= kTime) {
      missing_ = told_ - needed;
    }
    told_ = needed + std::max(0.0, left_ / kTime) * missing_;
    left_ -= period;
    return told_;
  }

 private:
  static constexpr double kTime = 0.1;  // s
  double left_ = 0;                     // until all of it is told
  Joints told_ = Joints::Zero();
  Joints missing_ = Joints::Zero();
};

}  // namespace indurop::robot
