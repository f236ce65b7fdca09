// SPDX-License-Identifier: Apache-2.0
#include "jerk_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace indurop::robot {

namespace {

constexpr int kRows = kAxes + 1;  // the joints, and x itself
constexpr int kTable = 4000;
constexpr int kInstants = 240;
using Row = Eigen::Matrix<double, kRows, 1>;
using Rows = std::vector<Row>;

// Differences of first, second and third order: the latest instant first.
constexpr double kDifferences[3][4] = {{1, -1, 0, 0}, {1, -2, 1, 0}, {1, -3, 3, -1}};

class Descent {
 public:
  explicit Descent(const JerkTask& task) : length_(task.speeds.length), step_(length_ / kTable) {
    const auto row = [](const Joints& joints, double last) {
      Row r;
      r << joints, last;
      return r;
    };
    for (int i = 0; i <= kTable; ++i) {
      table_.push_back(row(task.speeds.path(step_ * i), step_ * i));
    }
    most_ = {row(task.speeds.most_speed, task.speeds.fastest), row(task.speeds.most_acceleration, task.speeds.hardest),
             row(task.most_jerk, task.jerk)};
    x_.resize(kInstants + 1);
    for (int i = 0; i <= kInstants; ++i) {
      const double u = static_cast<double>(i) / kInstants;
      x_[at(i)] = length_ * u * u * u * u * (35 - u * (84 - u * (70 - 20 * u)));  // at rest with jerk 0
    }
  }

  double time() {
    spacing_ = 1e-3;
    while (!std::isfinite(height(x_, spacing_))) {
      if (spacing_ > 10) {
        return 0;
      }
      spacing_ *= 1.5;
    }
    // All of the logarithms together may cost 0.2 % of the time in the end.
    const double count = 3.0 * kRows * kInstants;
    for (weight_ = spacing_ * kInstants / count; weight_ > 0.002 * spacing_ * kInstants / count; weight_ *= 0.4) {
      for (int i = 0; i < 25 && go_down() > 1e-3 * weight_ * kInstants; ++i) {
      }
    }
    return spacing_ * kInstants;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  // Joint angles at x, and how they change with it: a cubic through four places of the table.
  void look(double x, Row& value, Row& slope) const {
    const double place = std::clamp(x / step_, 0.0, static_cast<double>(kTable));
    const int i = std::clamp(static_cast<int>(place), 1, kTable - 2);
    const double u = place - i;
    const Row& a = table_[at(i - 1)];
    const Row& b = table_[at(i)];
    const Row& c = table_[at(i + 1)];
    const Row& d = table_[at(i + 2)];
    const Row c1 = c - a / 3 - b / 2 - d / 6;
    const Row c2 = (a + c) / 2 - b;
    const Row c3 = (d - a) / 6 + (b - c) / 2;
    value = b + u * (c1 + u * (c2 + u * c3));
    slope = (c1 + u * (2 * c2 + 3 * u * c3)) / step_;
  }
  void look(const std::vector<double>& x, Rows& values, Rows& slopes) const {
    values.resize(x.size());
    slopes.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      look(x[i], values[i], slopes[i]);
    }
  }
  // Before the first and behind the last instant it rests.
  static const Row& of(const Rows& rows, int i) { return rows[at(std::clamp(i, 0, kInstants))]; }
  [[nodiscard]] Row part(const Rows& values, int i, int order, double spacing) const {
    const double* d = kDifferences[order];
    const Row sum =
        d[0] * of(values, i) + d[1] * of(values, i - 1) + d[2] * of(values, i - 2) + d[3] * of(values, i - 3);
    return sum.cwiseQuotient(most_[at(order)]) / std::pow(spacing, order + 1);
  }
  [[nodiscard]] double height(const std::vector<double>& x, double spacing) const {
    Rows values;
    Rows slopes;
    look(x, values, slopes);
    double sum = 0;
    for (int i = 1; i <= kInstants + 2; ++i) {
      if (i <= kInstants && !(x[at(i)] > x[at(i - 1)])) {
        return HUGE_VAL;
      }
      for (int order = 0; order < 3; ++order) {
        const Row g = part(values, i, order, spacing);
        const Row left = Row::Ones() - g.cwiseProduct(g);
        if (!(left.minCoeff() > 0)) {
          return HUGE_VAL;
        }
        sum += std::log(left.prod());
      }
    }
    return spacing * kInstants - weight_ * sum;
  }

  // One step; returns how much it was expected to bring.
  double go_down() {
    collect();
    const std::vector<double> by_slope = solve(gradient_);
    const std::vector<double> by_border = solve(border_);
    double bottom = corner_;
    double right = corner_gradient_;
    for (std::size_t i = 0; i < by_slope.size(); ++i) {
      bottom -= border_[i] * by_border[i];
      right -= border_[i] * by_slope[i];
    }
    const double stretch = -right / bottom;
    std::vector<double> direction(x_.size(), 0.0);
    double gain = -corner_gradient_ * stretch;
    for (int i = 1; i < kInstants; ++i) {
      const auto k = at(i - 1);
      direction[at(i)] = -by_slope[k] - stretch * by_border[k];
      gain -= gradient_[k] * direction[at(i)];
    }
    const double here = height(x_, spacing_);
    for (double part = 1; part > 1e-6; part /= 2) {
      std::vector<double> x = x_;
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] += part * direction[i];
      }
      const double spacing = spacing_ + part * stretch;
      if (spacing > 0 && height(x, spacing) < here - 0.05 * part * gain) {
        x_ = x;
        spacing_ = spacing;
        return gain;
      }
    }
    return 0;
  }

  // Gradient and curvature by the inner places (a band) and by the spacing (its border).
  void collect() {
    Rows values;
    Rows slopes;
    look(x_, values, slopes);
    const auto n = at(kInstants - 1);
    gradient_.assign(n, 0.0);
    border_.assign(n, 0.0);
    band_.assign(n, {});
    corner_ = 1e-9;
    corner_gradient_ = kInstants;
    for (int i = 1; i <= kInstants + 2; ++i) {
      for (int order = 0; order < 3; ++order) {
        add(slopes, i, order, part(values, i, order, spacing_));
      }
    }
  }
  void add(const Rows& slopes, int i, int order, const Row& g) {
    const double scale = std::pow(spacing_, -(order + 1));
    for (int r = 0; r < kRows; ++r) {
      const double left = 1 - g[r] * g[r];
      const double first = weight_ * 2 * g[r] / left;
      const double second = weight_ * (2 / left + 4 * g[r] * g[r] / (left * left));
      std::array<double, 4> by{};
      for (int c = 0; c <= order + 1; ++c) {
        if (i - c > 0 && i - c < kInstants) {
          by[at(c)] = kDifferences[order][c] * slopes[at(i - c)][r] * scale / most_[at(order)][r];
        }
      }
      const double by_spacing = -(order + 1) * g[r] / spacing_;
      corner_gradient_ += first * by_spacing;
      corner_ += second * by_spacing * by_spacing;
      for (int c = 0; c <= order + 1; ++c) {
        if (i - c <= 0 || i - c >= kInstants) {
          continue;
        }
        const auto k = at(i - c - 1);
        gradient_[k] += first * by[at(c)];
        border_[k] += second * by[at(c)] * by_spacing;
        for (int d = c; d <= order + 1 && i - d > 0; ++d) {
          band_[k][at(d - c)] += second * by[at(c)] * by[at(d)];
        }
      }
    }
  }
  // With the band: row k has itself and the three before it. The first call after collect() makes the factors.
  std::vector<double> solve(std::vector<double> right) {
    const auto n = right.size();
    std::vector<std::array<double, 4>> l = band_;
    for (std::size_t k = 0; k < n; ++k) {
      l[k][0] *= 1 + 1e-12;
      for (std::size_t j = std::min<std::size_t>(3, k); j >= 1; --j) {
        double sum = l[k][j];
        for (std::size_t m = j + 1; m <= 3 && m <= k; ++m) {
          sum -= l[k][m] * l[k - j][m - j] * l[k - m][0];
        }
        l[k][j] = sum / l[k - j][0];
      }
      for (std::size_t m = 1; m <= 3 && m <= k; ++m) {
        l[k][0] -= l[k][m] * l[k][m] * l[k - m][0];
      }
      for (std::size_t m = 1; m <= 3 && m <= k; ++m) {
        right[k] -= l[k][m] * right[k - m];
      }
    }
    for (std::size_t k = n; k-- > 0;) {
      right[k] /= l[k][0];
      for (std::size_t m = 1; m <= 3 && k + m < n; ++m) {
        right[k] -= l[k + m][m] * right[k + m];
      }
    }
    return right;
  }

  double length_, step_;
  Rows table_;
  std::array<Row, 3> most_;
  std::vector<double> x_;
  double spacing_ = 0, weight_ = 1e-9;
  std::vector<double> gradient_, border_;
  std::vector<std::array<double, 4>> band_;
  double corner_ = 0, corner_gradient_ = 0;
};

}  // namespace

double least_time(const JerkTask& task) {
  return Descent(task).time();
}

}  // namespace indurop::robot
