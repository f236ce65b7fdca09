// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/cam.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

using Column = std::array<double, kCamPoints>;

// Solves a diagonally dominant tridiagonal system; `right` becomes the solution.
void solve(std::size_t count, const Column& lower, const Column& diagonal, const Column& upper,
           Column& right) noexcept {
  Column scaled{};
  double pivot = diagonal[0];
  right[0] /= pivot;
  for (std::size_t i = 1; i < count; ++i) {
    scaled[i] = upper[i - 1] / pivot;
    pivot = diagonal[i] - lower[i] * scaled[i];
    right[i] = (right[i] - lower[i] * right[i - 1]) / pivot;
  }
  for (std::size_t i = count - 1; i-- > 0;) {
    right[i] -= scaled[i + 1] * right[i + 1];
  }
}

}  // namespace

ErrorCode Cam::set(const CamTable& table, bool periodic) noexcept {
  const std::size_t least = periodic ? 3 : 2;
  if (table.points < static_cast<int>(least) || table.points > static_cast<int>(kCamPoints)) {
    return ErrorCode::Value;
  }
  const auto count = static_cast<std::size_t>(table.points);
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(table.master[i]) || !std::isfinite(table.slave[i]) ||
        (i > 0 && !(table.master[i] > table.master[i - 1]))) {
      return ErrorCode::Value;
    }
  }
  count_ = count;
  periodic_ = periodic;
  for (std::size_t i = 0; i < count; ++i) {
    points_[i] = {table.master[i], table.slave[i], 0, 0};
  }
  bend_through();
  size_ = 0;
  for (std::size_t i = 0; i + 1 < count_; ++i) {
    for (const double power : between(points_[i], points_[i + 1], points_[i].x).powers) {
      size_ = std::max(size_, std::abs(power));
    }
  }
  return ErrorCode::Ok;
}

// Computes the slopes and second derivatives of the cubic spline through the points. The curve has the same at its
// points; at the ends of a non-periodic cam both are 0.
void Cam::bend_through() noexcept {
  const std::size_t last = count_ - 1;
  Column lower{};
  Column diagonal{};
  Column upper{};
  Column slopes{};
  const auto width = [&](std::size_t i) { return points_[i + 1].x - points_[i].x; };
  const auto steep = [&](std::size_t i) { return (points_[i + 1].y - points_[i].y) / width(i); };
  for (std::size_t i = 1; i < last; ++i) {
    lower[i] = 1 / width(i - 1);
    upper[i] = 1 / width(i);
    diagonal[i] = 2 * (lower[i] + upper[i]);
    slopes[i] = 3 * (steep(i - 1) * lower[i] + steep(i) * upper[i]);
  }
  if (periodic_) {
    // The last point is the first one. Sherman-Morrison formula: the two corners of the matrix are handled separately.
    const double corner = 1 / width(last - 1);
    upper[0] = 1 / width(0);
    const double first = 2 * (corner + upper[0]);
    slopes[0] = 3 * (steep(last - 1) * corner + steep(0) * upper[0]);
    diagonal[0] = 2 * first;
    diagonal[last - 1] += corner * corner / first;
    Column apart{};
    apart[0] = -first;
    apart[last - 1] = corner;
    solve(last, lower, diagonal, upper, slopes);
    solve(last, lower, diagonal, upper, apart);
    const double part =
        (slopes[0] - corner / first * slopes[last - 1]) / (1 + apart[0] - corner / first * apart[last - 1]);
    for (std::size_t i = 0; i < last; ++i) {
      slopes[i] -= part * apart[i];
    }
    slopes[last] = slopes[0];
  } else {
    diagonal[0] = diagonal[last] = 1;
    solve(count_, lower, diagonal, upper, slopes);
  }
  for (std::size_t i = 0; i <= last; ++i) {
    points_[i].slope = slopes[i];
    points_[i].bend = i < last ? (6 * steep(i) - 4 * slopes[i] - 2 * slopes[i + 1]) / width(i) : 0;
  }
  if (periodic_) {
    points_[last].bend = points_[0].bend;
  } else {
    points_[0].bend = 0;
  }
}

// The unique polynomial of fifth order with position, slope and second derivative of both points.
Cam::Part Cam::between(const Point& a, const Point& b, double x) noexcept {
  const double h = b.x - a.x;
  const double t = (x - a.x) / h;
  const double way = b.y - a.y;
  const double v0 = a.slope * h;
  const double v1 = b.slope * h;
  const double a0 = a.bend * h * h / 2;
  const double a1 = b.bend * h * h / 2;
  const double third = 10 * way - 6 * v0 - 4 * v1 - 3 * a0 + a1;
  const double fourth = -15 * way + 8 * v0 + 7 * v1 + 3 * a0 - 2 * a1;
  const double fifth = 6 * way - 3 * v0 - 3 * v1 - a0 + a1;
  return {{a.y, v0, a0, third, fourth, fifth}, h, t};
}

double Cam::Part::position() const noexcept {
  const auto& c = powers;
  return c[0] + part * (c[1] + part * (c[2] + part * (c[3] + part * (c[4] + part * c[5]))));
}

double Cam::Part::slope() const noexcept {
  const auto& c = powers;
  return (c[1] + part * (2 * c[2] + part * (3 * c[3] + part * (4 * c[4] + part * 5 * c[5])))) / width;
}

double Cam::stride() const noexcept {
  return count_ > 0 ? points_[count_ - 1].y - points_[0].y : 0;
}

// Beyond the ends of a cam that is not periodic, it is at the end.
Cam::Part Cam::part_at(double master) const noexcept {
  const Point& first = points_[0];
  const Point& last = points_[count_ - 1];
  const double turns = periodic_ ? std::floor((master - first.x) / (last.x - first.x)) : 0;
  const double x = std::clamp(master - turns * (last.x - first.x), first.x, last.x);
  const auto* const begin = points_.begin();
  const auto* const next = std::upper_bound(begin + 1, begin + count_ - 1, x,
                                            [](double place, const Point& point) { return place < point.x; });
  Part part = between(*(next - 1), *next, x);
  part.turns = turns;
  return part;
}

double Cam::at(double master) const noexcept {
  if (count_ == 0) {
    return 0;
  }
  const Part part = part_at(master);
  return part.turns * stride() + part.position();
}

double Cam::slope_at(double master) const noexcept {
  return count_ == 0 ? 0 : part_at(master).slope();
}

std::pair<double, double> Cam::extent() const noexcept {
  constexpr int kSamples = 16;  // in each part
  std::pair<double, double> found{HUGE_VAL, -HUGE_VAL};
  for (std::size_t i = 0; i + 1 < count_; ++i) {
    for (int k = 0; k <= kSamples; ++k) {
      const double x = points_[i].x + (points_[i + 1].x - points_[i].x) * k / kSamples;
      const double y = between(points_[i], points_[i + 1], x).position();
      found = {std::min(found.first, y), std::max(found.second, y)};
    }
  }
  return found;
}

}  // namespace indurop::robot
