// SPDX-License-Identifier: Apache-2.0
// Set points that come in a stream (MoveIt Servo): each replaces the one before in mid-move, and the arm comes to rest
// when no more arrive. For one thread.

#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "doors/ros/arm/arm.h"
#include "doors/ros/arm/commands.h"

namespace indurop::ros {

class Servo {
 public:
  using Time = std::chrono::nanoseconds;  // monotonic

  // Both are borrowed until the end. `stale`: without a set point for so long, the arm comes to rest.
  Servo(Arm& arm, Commands& commands, Time stale) : arm_(&arm), commands_(&commands), stale_(stale) {}

  // Positions of all axes, degrees or mm. Returns why it is refused; empty: the arm moves there.
  std::string move(const std::vector<double>& positions, Time now);
  // The arm comes to rest.
  void stop();
  // Stops the arm when the stream has grown stale. Returns true if it does so now and the arm was moving.
  bool step(Time now);
  [[nodiscard]] bool is_active() const noexcept { return active_; }
  // Returns why the robot refused a set point, once; empty: it did not.
  std::string take_trouble() { return std::exchange(trouble_, {}); }

 private:
  void judge_last();

  Arm* arm_;
  Commands* commands_;
  Time stale_;
  Time last_{0};
  bool active_ = false;
  Order order_;  // the last one
  std::string trouble_;
};

}  // namespace indurop::ros
