// SPDX-License-Identifier: Apache-2.0
// The timing of a path: its place as a smooth function of time, from rest to rest. It consists of two splines: one
// gives the place as a function of a parameter whose knots are dense where much happens, the other the square of the
// speed of that parameter.

#pragma once

#include <array>

namespace indurop::robot {

// The place on a path at some time, and its derivatives with respect to time.
struct Timed {
  double place = 0;
  double speed = 1;
  double acceleration = 0;
  double jerk = 0;
};

class PathTiming {
 public:
  static constexpr int kMaxPieces = 256;
  struct Value {
    double value = 0, first = 0, second = 0, third = 0;
  };

  // Returns whether there is a timing; without one, the place is the time.
  [[nodiscard]] bool known() const noexcept { return count_ > 0; }
  [[nodiscard]] double duration() const noexcept { return times_[static_cast<std::size_t>(count_)]; }
  // `time` is from 0 to duration(). Real-time safe, like all functions of this class.
  [[nodiscard]] Timed at(double time) const noexcept;

  // Sets the timing. `shape`: B-spline coefficients of the place (degree 5), `count` + 5 of them; `squares`:
  // coefficients of the square of the parameter's speed (degree 3), `count` + 3.
  void set(int count, const double* shape, const double* squares) noexcept;
  void slow_down(double factor) noexcept;  // the whole timing; factor >= 1
  [[nodiscard]] int count() const noexcept { return count_; }
  // The piece in which that time lies, from 0 to duration(); requires known().
  [[nodiscard]] int piece_at(double time) const noexcept;

 private:
  [[nodiscard]] Value place(int piece, double part) const noexcept;
  [[nodiscard]] double seconds(int piece, double part) const noexcept;

  int count_ = 0;
  std::array<double, kMaxPieces + 5> shape_{};
  std::array<double, kMaxPieces + 3> squares_{};
  std::array<double, kMaxPieces + 1> times_{};
};

}  // namespace indurop::robot
