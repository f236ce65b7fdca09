// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/timing.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

// A uniform B-spline piece of degree 5 and its first three derivatives, by de Boor's triangle.
PathTiming::Value spline(const double* coefficients, double part) noexcept {
  constexpr std::size_t kDegree = 5;
  // Differences give the derivatives; the remaining degree is evaluated.
  std::array<double, kDegree + 1> c{};
  std::copy_n(coefficients, kDegree + 1, c.begin());
  std::array<double, 4> result{};
  for (std::size_t order = 0; order <= 3; ++order) {
    const std::size_t degree = kDegree - order;
    std::array<double, kDegree + 1> d = c;
    for (std::size_t level = 1; level <= degree; ++level) {
      for (std::size_t i = degree; i >= level; --i) {
        const double weight = (part + static_cast<double>(degree - i)) / static_cast<double>(degree - level + 1);
        d[i] = (1 - weight) * d[i - 1] + weight * d[i];
      }
    }
    result[order] = d[degree];
    for (std::size_t i = 0; i < degree; ++i) {
      c[i] = c[i + 1] - c[i];
    }
  }
  return {result[0], result[1], result[2], result[3]};
}

// A uniform cubic B-spline piece as a polynomial of the part.
struct Cubic {
  explicit Cubic(const double* z) noexcept
      : a((z[0] + 4 * z[1] + z[2]) / 6),
        b((z[2] - z[0]) / 2),
        c((z[0] - 2 * z[1] + z[2]) / 2),
        d((z[3] - 3 * z[2] + 3 * z[1] - z[0]) / 6) {}
  [[nodiscard]] double at(double x) const noexcept { return a + x * (b + x * (c + x * d)); }
  [[nodiscard]] double slope(double x) const noexcept { return b + x * (2 * c + x * 3 * d); }
  [[nodiscard]] double bend(double x) const noexcept { return 2 * c + x * 6 * d; }
  // Distance from x over which Gaussian quadrature of one over its root is exact enough: the quadrature is as good as
  // the zeros under the root are far away, here at least three halves of the distance. Where a path begins or ends they
  // are near.
  [[nodiscard]] double stretch(double x) const noexcept {
    constexpr double kOfWay = 2.0 / 3;
    constexpr double kLeast = 1e-6;
    const double here = at(x);
    const double nearest =
        here / (std::abs(slope(x)) + std::sqrt(here * std::abs(bend(x)) / 2) + std::cbrt(here * here * std::abs(d)));
    return std::max(kOfWay * nearest, kLeast);
  }
  double a, b, c, d;
};

double seconds_between(const Cubic& square, double from, double to) noexcept {
  constexpr std::array kAt{0.01985507175123188, 0.10166676129318664, 0.23723379504183550, 0.40828267875217510,
                           0.59171732124782490, 0.76276620495816450, 0.89833323870681336, 0.98014492824876812};
  constexpr std::array kWeight{0.05061426814518813, 0.11119051722668724, 0.15685332293894363, 0.18134189168918099,
                               0.18134189168918099, 0.15685332293894363, 0.11119051722668724, 0.05061426814518813};
  double sum = 0;
  for (std::size_t i = 0; i < kAt.size(); ++i) {
    sum += kWeight[i] / std::sqrt(square.at(from + (to - from) * kAt[i]));
  }
  return (to - from) * sum;
}

}  // namespace

PathTiming::Value PathTiming::place(int piece, double part) const noexcept {
  return spline(shape_.data() + piece, part);
}

// Time from the beginning of the piece. An error would show as a step of speed between pieces.
double PathTiming::seconds(int piece, double part) const noexcept {
  const Cubic square(squares_.data() + piece);
  double sum = 0;
  for (double x = 0; x < part;) {
    const double next = std::min(part, x + square.stretch(x));
    sum += seconds_between(square, x, next);
    x = next;
  }
  return sum;
}

void PathTiming::set(int count, const double* shape, const double* squares) noexcept {
  count_ = count;
  std::copy_n(shape, count + 5, shape_.begin());
  std::copy_n(squares, count + 3, squares_.begin());
  times_[0] = 0;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    times_[k + 1] = times_[k] + seconds(i, 1);
  }
}

void PathTiming::slow_down(double factor) noexcept {
  for (double& z : squares_) {
    z /= factor * factor;
  }
  for (double& t : times_) {
    t *= factor;
  }
}

int PathTiming::piece_at(double time) const noexcept {
  const double* first = times_.data() + 1;
  return static_cast<int>(std::upper_bound(first, times_.data() + count_, time) - first);
}

Timed PathTiming::at(double time) const noexcept {
  const int piece = piece_at(time);
  const double begin = times_[static_cast<std::size_t>(piece)];
  const double length = times_[static_cast<std::size_t>(piece) + 1] - begin;
  const double rest = std::clamp(time - begin, 0.0, length);
  // Newton steps from a cubic with the right speeds at both ends; the remaining error is squared with each step. Two
  // are enough, except where a path begins slowly and is many times as fast at the end of the piece: too few steps
  // would leave a step of place between pieces.
  constexpr double kNearly = 1e-9;
  constexpr int kMostSteps = 16;
  const double x = rest / length;
  const Cubic squared(squares_.data() + piece);
  const double begin_speed = length * std::sqrt(squared.at(0));
  const double end_speed = length * std::sqrt(squared.at(1));
  double part = x * (begin_speed + x * (3 - 2 * begin_speed - end_speed + x * (begin_speed + end_speed - 2)));
  for (int i = 0; i < kMostSteps; ++i) {
    part = std::clamp(part, 0.0, 1.0);
    const double off = seconds(piece, part) - rest;
    part -= off * std::sqrt(squared.at(part));
    if (std::abs(off) < kNearly * length) {
      break;
    }
  }
  part = std::clamp(part, 0.0, 1.0);
  const Value s = place(piece, part);
  const double square = squared.at(part);
  const double slope = squared.slope(part);
  const double u = std::sqrt(square);
  return {s.value, s.first * u, s.second * square + s.first * slope / 2,
          u * (s.third * square + 1.5 * s.second * slope + s.first * squared.bend(part) / 2)};
}

}  // namespace indurop::robot
