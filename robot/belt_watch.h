// SPDX-License-Identifier: Apache-2.0
// Where a conveyor or a rotary table is, made smooth: its place is measured in steps and told once in a while, and a
// robot that went by that would shake. At a steady speed or acceleration it is exact, without a lag.

#pragma once

#include <indurop/robot/controller.h>

#include "robot/profile.h"

namespace indurop::robot {

class BeltWatch {
 public:
  explicit BeltWatch(double period = 0.01) noexcept;

  // Once a period: what its reader tells. Real-time safe, as all here.
  void sense(const BeltIn& in) noexcept;
  // It has been told for long enough to be relied on, and goes on being told.
  [[nodiscard]] bool known() const noexcept { return told_for_ >= kSettles; }
  // It is not, since what it told cannot be.
  [[nodiscard]] bool jumped() const noexcept { return jumped_; }
  // mm or degrees; velocity and acceleration as differences between periods.
  [[nodiscard]] const LineState& now() const noexcept { return now_; }
  // The same of the period before.
  [[nodiscard]] const LineState& before() const noexcept { return before_; }

 private:
  static constexpr double kSettles = 0.3;   // s
  static constexpr double kPatience = 0.1;  // s without a beat

  void hear(double place, double seconds) noexcept;
  void begin_anew() noexcept;

  double period_;
  double pull_;  // 1/s, of the smooth place towards the measured one
  bool first_ = true;
  std::uint32_t beat_ = 0;
  int heard_ = 0;      // places, up to 2
  double silent_ = 0;  // s since the last one
  double told_for_ = 0;
  bool jumped_ = false;
  LineState measured_;  // estimated from what was told
  LineState smooth_;    // goes after it by its jerk only
  double jerk_ = 0;
  LineState now_, before_;
};

}  // namespace indurop::robot
