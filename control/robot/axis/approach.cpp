// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/approach.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

// Three powers are free, and its end sets three conditions: position, slope and zero curvature.
Approach::Approach(double from, double to, double start, double end, double slope) noexcept
    : known_(true), from_(from), length_(to - from), start_(start) {
  const double way = end - start;
  const double rise = slope * length_;
  third_ = 10 * way - 4 * rise;
  fourth_ = 7 * rise - 15 * way;
  fifth_ = 6 * way - 3 * rise;
}

double Approach::at(double master) const noexcept {
  return curve(std::clamp(part(master), 0.0, 1.0));
}

double Approach::slope_at(double master) const noexcept {
  const double x = std::clamp(part(master), 0.0, 1.0);
  return x * x * (3 * third_ + x * (4 * fourth_ + x * 5 * fifth_)) / length_;
}

double Approach::size() const noexcept {
  return std::max({std::abs(start_), std::abs(third_), std::abs(fourth_), std::abs(fifth_)});
}

std::pair<double, double> Approach::extent() const noexcept {
  std::pair<double, double> both = std::minmax({curve(0), curve(1)});
  const auto look = [&](double where) {
    if (where > 0 && where < 1) {
      both = {std::min(both.first, curve(where)), std::max(both.second, curve(where))};
    }
  };
  // Places with slope 0, apart from the beginning: 3 third + 4 fourth x + 5 fifth x^2 = 0.
  const double a = 5 * fifth_;
  const double b = 2 * fourth_;
  const double c = 3 * third_;
  const double root = b * b - a * c;
  if (root >= 0) {
    const double q = -(b + std::copysign(std::sqrt(root), b));
    look(q / a);
    look(c / q);
  }
  return both;
}

}  // namespace indurop::robot
