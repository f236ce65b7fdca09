// SPDX-License-Identifier: Apache-2.0
// When a path is where: its place as a smooth function of time, from rest to rest. Two splines make it: one gives the
// place by a parameter whose knots lie where much happens, the other the square of the speed of that parameter.

#pragma once

#include <array>

namespace indurop::robot {

// The place on a path at some time, and its derivatives by time.
struct Timed {
  double place = 0;
  double speed = 1;
  double acceleration = 0;
  double jerk = 0;
};

class PathTiming {
 public:
  static constexpr int kMost = 256;  // pieces
  struct Value {
    double value = 0, first = 0, second = 0, third = 0;
  };

  // Nothing is known: the place is the time.
  [[nodiscard]] bool known() const noexcept { return count_ > 0; }
  [[nodiscard]] double duration() const noexcept { return times_[static_cast<std::size_t>(count_)]; }
  // `time` is from 0 to duration(). Real-time safe, as all here.
  [[nodiscard]] Timed at(double time) const noexcept;

  // Of the one who makes it. `shape`: B-spline coefficients of the place (degree 5), `count` + 5 of them; `squares`:
  // those of the square of the parameter's speed (degree 3), `count` + 3.
  void set(int count, const double* shape, const double* squares) noexcept;
  void slow_down(double factor) noexcept;  // as a whole; factor >= 1
  [[nodiscard]] int count() const noexcept { return count_; }
  // Where that time is, likewise; known().
  [[nodiscard]] int piece_at(double time) const noexcept;

 private:
  [[nodiscard]] Value place(int piece, double part) const noexcept;
  [[nodiscard]] double seconds(int piece, double part) const noexcept;

  int count_ = 0;
  std::array<double, kMost + 5> shape_{};
  std::array<double, kMost + 3> squares_{};
  std::array<double, kMost + 1> times_{};
};

}  // namespace indurop::robot
