// SPDX-License-Identifier: Apache-2.0
// The smoothed position of a conveyor or a rotary table: its position is measured in steps and reported now and then,
// and a robot that followed these values directly would shake. At a steady speed or acceleration it is exact, without a
// lag.

#pragma once

#include <indurop/robot/controller.h>

#include "control/robot/path/profile.h"

namespace indurop::robot {

class BeltEstimator {
 public:
  explicit BeltEstimator(double period = 0.01) noexcept;

  // Takes the value of its reader once a period. All functions of this class are real-time safe.
  void sense(const BeltIn& in) noexcept;
  // Returns whether its position has been reported for long enough to be relied on, and still is.
  [[nodiscard]] bool known() const noexcept { return known_for_ >= kSettles; }
  // Returns whether it is unknown because an impossible position was reported.
  [[nodiscard]] bool jumped() const noexcept { return jumped_; }
  // The present state in mm or degrees; velocity and acceleration as differences between periods.
  [[nodiscard]] const LineState& now() const noexcept { return now_; }
  // The state of the previous period.
  [[nodiscard]] const LineState& before() const noexcept { return before_; }

 private:
  static constexpr double kSettles = 0.3;   // s
  static constexpr double kPatience = 0.1;  // s without a beat

  void take(double place, double seconds) noexcept;
  void restart() noexcept;

  double period_;
  double pull_;  // 1/s, rate of the smoothed position towards the measured one
  bool first_ = true;
  std::uint32_t beat_ = 0;
  int received_ = 0;      // positions received, up to 2
  double silent_ = 0;     // s since the last one
  double known_for_ = 0;  // s
  bool jumped_ = false;
  LineState measured_;  // estimated from the reported positions
  LineState smooth_;    // follows the estimate, changing its jerk only
  double jerk_ = 0;
  LineState now_, before_;
};

}  // namespace indurop::robot
