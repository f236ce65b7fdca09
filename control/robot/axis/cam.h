// SPDX-License-Identifier: Apache-2.0
// A cam: the position of a follower for each position of its master, through the points of a table. Speed and
// acceleration have no jumps if the master's have none.

#pragma once

#include <indurop/robot/controller.h>

#include <utility>

namespace indurop::robot {

class Cam {
 public:
  // Sets a curve through all points. Periodic: the end continues at the beginning, one stride further if they differ.
  // Otherwise the curve begins and ends at rest and stays constant beyond its ends. Errors: Value (fewer than two
  // points, or three if periodic; not numbers; a position of the master that is not after the previous one); then the
  // cam is unchanged. All functions of this class are real-time safe.
  ErrorCode set(const CamTable& table, bool periodic) noexcept;
  [[nodiscard]] bool known() const noexcept { return count_ > 0; }

  [[nodiscard]] double at(double master) const noexcept;
  // Returns the motion of the follower per unit of master motion.
  [[nodiscard]] double slope_at(double master) const noexcept;
  // Returns the greatest number that at() adds up within a turn.
  [[nodiscard]] double size() const noexcept { return size_; }
  // Returns the smallest and the greatest position of the follower within one turn.
  [[nodiscard]] std::pair<double, double> extent() const noexcept;
  // Returns the offset that each turn adds.
  [[nodiscard]] double stride() const noexcept;

 private:
  struct Point {
    double x = 0, y = 0;
    double slope = 0, bend = 0;  // first and second derivative
  };
  // A part of the curve as a polynomial from 0 to 1, and where on it a position of the master is.
  struct Part {
    std::array<double, 6> powers{};  // coefficients
    double width = 1;                // of the master
    double part = 0;
    double turns = 0;  // before it
    [[nodiscard]] double position() const noexcept;
    [[nodiscard]] double slope() const noexcept;
  };
  void bend_through() noexcept;
  static Part between(const Point& a, const Point& b, double x) noexcept;
  [[nodiscard]] Part part_at(double master) const noexcept;

  std::array<Point, kCamPoints> points_{};
  std::size_t count_ = 0;
  double size_ = 0;
  bool periodic_ = false;
};

}  // namespace indurop::robot
