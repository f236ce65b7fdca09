// SPDX-License-Identifier: Apache-2.0
// Homing of a drive by the methods of CiA 402 (IEC 61800-7-201, object 0x6098): the direction of motion until a switch
// or mark is found. Real-time safe.

#pragma once

#include <optional>

#include "config/model/io_config.h"

namespace indurop::io {

// The states of the switches of an axis at a position, degrees.
struct AxisSwitches {
  bool low = false;   // limit switch at the lower end
  bool high = false;  // limit switch at the upper end
  bool home = false;
};
AxisSwitches switches_at(const config::IoAxis& axis, double degrees) noexcept;

class Homing {
 public:
  enum class State { Idle, Moving, Done, Failed };

  explicit Homing(const config::IoAxis& axis) noexcept : axis_(axis) {}

  void start() noexcept;
  void forget() noexcept { state_ = State::Idle; }

  // One step of the axis from a position to the next, degrees; returns the velocity to continue with, degrees / s. Once
  // Done, the axis must stop, and home() is the position that becomes 0.
  double step(double before, double now) noexcept;

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] double home() const noexcept { return home_; }

 private:
  enum class Switch { None, Low, High, Home };
  // A homing method: find the edge of a switch by moving in direction `search` until the switch is on; cross it slowly
  // in direction `cross`, as the switch goes on or off; then optionally find the next mark.
  struct Method {
    Switch edge = Switch::None;
    int search = 0;
    int cross = 0;
    bool goes_on = false;
    bool mark = false;
  };
  enum class Phase { Search, Back, Cross, Mark };

  static Method method_of(int number) noexcept;
  [[nodiscard]] bool is_on(const AxisSwitches& switches) const noexcept;
  void found(double at) noexcept;
  void search(const AxisSwitches& now) noexcept;

  const config::IoAxis& axis_;
  Method method_;
  State state_ = State::Idle;
  Phase phase_ = Phase::Search;
  int direction_ = 0;
  int turned_ = 0;  // number of reversals at a limit switch
  double home_ = 0;
};

}  // namespace indurop::io
