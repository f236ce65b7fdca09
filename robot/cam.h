// SPDX-License-Identifier: Apache-2.0
// A cam: where a follower is for each place of its master, through the points of a table. Speed and acceleration have
// no jumps if the master's have none.

#pragma once

#include <indurop/robot/controller.h>

#include <utility>

namespace indurop::robot {

class Cam {
 public:
  // Through all points. Periodic: its end is its beginning, one step further if they differ; else it comes from rest
  // and ends at rest, and stays there beyond its ends. Errors: Value (less than two points, of a periodic one three;
  // not numbers; a place of the master that is not behind the one before), and it is as before. Real-time safe, as all
  // here.
  ErrorCode set(const CamTable& table, bool periodic) noexcept;
  [[nodiscard]] bool known() const noexcept { return count_ > 0; }

  [[nodiscard]] double at(double master) const noexcept;
  // The least and the greatest place of the follower, of one turn.
  [[nodiscard]] std::pair<double, double> extent() const noexcept;
  // What each turn adds.
  [[nodiscard]] double stride() const noexcept;

 private:
  struct Point {
    double x = 0, y = 0;
    double slope = 0, bend = 0;  // first and second derivative
  };
  void bend_through() noexcept;
  static double between(const Point& a, const Point& b, double x) noexcept;

  std::array<Point, kCamPoints> points_{};
  std::size_t count_ = 0;
  bool periodic_ = false;
};

}  // namespace indurop::robot
