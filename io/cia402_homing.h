// SPDX-License-Identifier: Apache-2.0
// Homing of a drive by the methods of CiA 402 (IEC 61800-7-201, object 0x6098): which way to go until which switch or
// mark is found. Real-time safe.

#pragma once

#include <optional>

#include "config/model/io_config.h"

namespace indurop::io {

// What the switches on the way of an axis say at a position, degrees.
struct AxisSwitches {
  bool low = false;   // limit switch at the lower end
  bool high = false;  // and at the upper one
  bool home = false;
};
AxisSwitches switches_at(const config::IoAxis& axis, double degrees) noexcept;

class Homing {
 public:
  enum class State { Idle, Moving, Done, Failed };

  explicit Homing(const config::IoAxis& axis) noexcept : axis_(axis) {}

  void start() noexcept;
  void forget() noexcept { state_ = State::Idle; }

  // One step of the axis from a position to the next, degrees: how fast it is to go on, degrees / s. Once Done it is to
  // stop, and home() is where the position is 0.
  double step(double before, double now) noexcept;

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] double home() const noexcept { return home_; }

 private:
  enum class Switch { None, Low, High, Home };
  // A method in parts: the edge of a switch, found by going `search` until it is on; crossed slowly in direction
  // `cross`, as the switch goes on or off; and the mark behind it.
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
  int turned_ = 0;  // times a limit switch sent it back
  double home_ = 0;
};

}  // namespace indurop::io
