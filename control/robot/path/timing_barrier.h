// SPDX-License-Identifier: Apache-2.0
// Finds the shortest duration that keeps all limits at the knots of a timing, and if requested half way between them.
// The square of the parameter's speed makes these limits nearly linear, so a barrier method with a banded system finds
// it in a few dozen steps; each of them yields a timing that keeps the limits.

#pragma once

#include <array>

#include "control/robot/kinematics/arm.h"
#include "control/robot/path/timing.h"

namespace indurop::robot {

// Limits of the motion at one place, with respect to the parameter, as parts of the limits.
struct TimingPlace {
  static constexpr int kRows = kAxes + 1;  // the joints, and the place on the path itself for the tool
  // Rows of vectors, whose length is limited: the movement of the tool, and its rotation.
  static constexpr int kVectors = 2;
  static constexpr int kMoving = kRows, kTurning = kRows + 3;
  using Rows = std::array<double, kRows + 3 * kVectors>;
  double fastest = 0;             // maximum square of the parameter's speed
  Rows bend{}, drive{};           // acceleration = bend * w + drive * w'
  Rows third{}, mixed{}, last{};  // jerk * w^-1/2 = third * w + mixed * w' + last * w''
};

class TimingBarrier {
 public:
  static constexpr int kMaxPieces = PathTiming::kMaxPieces;
  // Access to the limits at the knots, or alternately at the knots and half way between them; filled in before begin().
  // Real-time safe, like all functions of this class.
  TimingPlace& place(int i) noexcept { return places_[static_cast<std::size_t>(i)]; }
  // Begins with knots 0 to `count`; `per_knot`: places from one knot to the next, 1 or 2. `vectors`: how many of them
  // count, all or none.
  void begin(int count, int per_knot, int vectors) noexcept;
  // Does a part of a step; returns the work done, as the number of places whose inverse kinematics take as long.
  int work() noexcept;
  [[nodiscard]] bool done() const noexcept { return stage_ == Stage::Done; }
  // B-spline coefficients of the square of the parameter's speed: `count` + 3 of them.
  [[nodiscard]] const double* squares() const noexcept { return z_.data(); }

 private:
  static constexpr int kRows = TimingPlace::kRows;
  enum class Stage { Derive, Solve, Descend, Done };
  struct Local {
    double w = 0, d = 0, dd = 0;  // value and its derivatives
  };
  static constexpr int kBand = 4;  // maximum number of coefficients that affect a place
  using Coefficients = std::array<double, kMaxPieces + 3>;

  [[nodiscard]] int last() const noexcept { return count_ * per_knot_; }
  [[nodiscard]] Local local(const double* z, int place) const noexcept;
  // The weight of a place in the duration.
  [[nodiscard]] double share(int place) const noexcept { return (place == 0 || place == last() ? 0.5 : 1) / per_knot_; }
  [[nodiscard]] double height(const double* z) const noexcept;
  // First and second derivatives with respect to w, w' and w''.
  struct Curve {
    std::array<double, 3> slope{};
    std::array<std::array<double, 3>, 3> bend{};
  };
  // Adds the barrier of a row, or of a vector whose rows begin there, at a place with these values; `root`: w^-1/2.
  void add_row(const TimingPlace& k, std::size_t r, const Local& m, double root, Curve& curve) const noexcept;
  void add_vector(const TimingPlace& k, std::size_t first, const Local& m, Curve& curve) const noexcept;
  void derive(int place) noexcept;
  void add(int place, const Curve& curve) noexcept;
  void hold_ends() noexcept;
  bool solve() noexcept;
  void begin_step() noexcept;
  void find_direction() noexcept;
  void descend() noexcept;
  void end_step(bool better) noexcept;

  Stage stage_ = Stage::Done;
  int count_ = 0;
  int per_knot_ = 1;
  int vectors_ = 0;
  int next_ = 0;
  int steps_ = 0;
  double weight_ = 0;  // of the barrier
  double stiff_ = 0;
  double here_ = 0, decrement_ = 0, length_ = 0;  // of the present step
  Coefficients z_{}, gradient_{}, direction_{}, trial_{};
  std::array<std::array<double, kBand>, kMaxPieces + 3> band_{};
  std::array<TimingPlace, 2 * kMaxPieces + 1> places_{};
};

}  // namespace indurop::robot
