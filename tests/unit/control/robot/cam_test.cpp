// SPDX-License-Identifier: Apache-2.0
// Cams against curves found another way: all coefficients of a spline from one dense system of equations, and those of
// each part from another one.
#include "control/robot/axis/cam.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {
namespace {

// y = a + b t + c t^2 + d t^3 in each part, t from its beginning.
class DenseSpline {
 public:
  DenseSpline(const std::vector<double>& x, const std::vector<double>& y, bool periodic) : x_(x), periodic_(periodic) {
    const auto parts = static_cast<Eigen::Index>(x.size()) - 1;
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4 * parts, 4 * parts);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(4 * parts);
    Eigen::Index row = 0;
    const auto derivative = [&](Eigen::Index part, double t, int order, double sign) {
      for (int power = order; power < 4; ++power) {
        double factor = 1;
        for (int k = 0; k < order; ++k) {
          factor *= power - k;
        }
        a(row, 4 * part + power) += sign * factor * std::pow(t, power - order);
      }
    };
    const auto width = [&](Eigen::Index i) {
      return x[static_cast<std::size_t>(i) + 1] - x[static_cast<std::size_t>(i)];
    };
    for (Eigen::Index i = 0; i < parts; ++i) {
      derivative(i, 0, 0, 1);
      b(row++) = y[static_cast<std::size_t>(i)];
      derivative(i, width(i), 0, 1);
      b(row++) = y[static_cast<std::size_t>(i) + 1];
      const bool last = i + 1 == parts;
      for (int order = 1; order <= 2 && (!last || periodic); ++order, ++row) {
        derivative(i, width(i), order, 1);
        derivative(last ? 0 : i + 1, 0, order, -1);
      }
    }
    if (!periodic) {
      derivative(0, 0, 1, 1);
      ++row;
      derivative(parts - 1, width(parts - 1), 1, 1);
    }
    coefficients_ = a.fullPivLu().solve(b);
  }
  // Place, slope and bend at a point.
  [[nodiscard]] Eigen::Vector3d knot(std::size_t i, const std::vector<double>& y) const {
    const std::size_t last = x_.size() - 1;
    const auto part = static_cast<Eigen::Index>(i == last ? last - 1 : i);
    const double t = x_[i] - x_[static_cast<std::size_t>(part)];
    const Eigen::Vector4d c = coefficients_.segment<4>(4 * part);
    const bool rests = !periodic_ && (i == 0 || i == last);
    return {y[i], c[1] + 2 * c[2] * t + 3 * c[3] * t * t, rests ? 0 : 2 * c[2] + 6 * c[3] * t};
  }
  // Of the polynomial of fifth order between two points.
  static double between(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double width, double t) {
    Eigen::Matrix<double, 6, 6> m = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right;
    right << a, b;
    for (int power = 0; power < 6; ++power) {
      m(0, power) = power == 0;
      m(1, power) = power == 1;
      m(2, power) = power == 2 ? 2 : 0;
      m(3, power) = std::pow(width, power);
      m(4, power) = power == 0 ? 0 : power * std::pow(width, power - 1);
      m(5, power) = power < 2 ? 0 : power * (power - 1) * std::pow(width, power - 2);
    }
    const Eigen::Matrix<double, 6, 1> c = m.fullPivLu().solve(right);
    double y = 0;
    for (int power = 0; power < 6; ++power) {
      y += c[power] * std::pow(t, power);
    }
    return y;
  }

 private:
  std::vector<double> x_;
  bool periodic_;
  Eigen::VectorXd coefficients_;
};

CamTable table_of(const std::vector<double>& x, const std::vector<double>& y) {
  CamTable table;
  table.points = static_cast<std::int16_t>(x.size());
  std::copy(x.begin(), x.end(), table.master.begin());
  std::copy(y.begin(), y.end(), table.slave.begin());
  return table;
}

TEST(CamTables, Are_the_curves_of_a_dense_system) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> gap(0.3, 2);
  std::uniform_real_distribution<double> place(-3, 3);
  for (int run = 0; run < 60; ++run) {
    const bool periodic = run % 2 == 0;
    const std::size_t count = 3 + static_cast<std::size_t>(run) % 12;
    std::vector<double> x{place(random)};
    std::vector<double> y{place(random)};
    while (x.size() < count) {
      x.push_back(x.back() + gap(random));
      y.push_back(place(random));
    }
    Cam sut;
    ASSERT_EQ(sut.set(table_of(x, y), periodic), ErrorCode::Ok);
    const DenseSpline spline(x, y, periodic);
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const double width = x[i + 1] - x[i];
      for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const double expected = DenseSpline::between(spline.knot(i, y), spline.knot(i + 1, y), width, t * width);
        ASSERT_NEAR(sut.at(x[i] + t * width), expected, 1e-8) << "run " << run << ", part " << i << " at " << t;
      }
    }
    // The next turn adds what this one did; a cam that ends stays there.
    const double length = x.back() - x.front();
    const double middle = x.front() + 0.4 * length;
    EXPECT_NEAR(sut.at(middle + length) - sut.at(middle),
                periodic ? y.back() - y.front() : sut.at(x.back()) - sut.at(middle), 1e-9);
    EXPECT_NEAR(sut.at(middle - 2 * length), periodic ? sut.at(middle) - 2 * (y.back() - y.front()) : y.front(), 1e-9);
  }
}

TEST(CamTables, Have_no_jumps_of_speed_and_acceleration) {
  Cam sut;
  ASSERT_EQ(sut.set(table_of({0, 1, 2.5, 4}, {0, 2, -1, 0.5}), true), ErrorCode::Ok);
  constexpr double kStep = 1e-3;
  double last = 0;
  for (double x = -5; x < 9; x += kStep) {
    const double bend = (sut.at(x + kStep) - 2 * sut.at(x) + sut.at(x - kStep)) / kStep / kStep;
    EXPECT_NEAR(bend, x == -5 ? bend : last, 0.2) << x;
    last = bend;
  }
}

TEST(CamTables, Of_wrong_tables_are_refused_and_change_nothing) {
  Cam sut;
  ASSERT_EQ(sut.set(table_of({0, 1}, {0, 5}), false), ErrorCode::Ok);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CamTable many = table_of({0, 1}, {0, 5});
  many.points = kCamPoints + 1;
  EXPECT_EQ(sut.set(many, false), ErrorCode::Value);
  EXPECT_EQ(sut.set(table_of({0}, {0}), false), ErrorCode::Value);
  EXPECT_EQ(sut.set(table_of({0, 1}, {0, 5}), true), ErrorCode::Value);
  EXPECT_EQ(sut.set(table_of({0, 2, 1}, {0, 5, 6}), false), ErrorCode::Value);
  EXPECT_EQ(sut.set(table_of({0, 1, 1}, {0, 5, 6}), false), ErrorCode::Value);
  EXPECT_EQ(sut.set(table_of({0, nan, 3}, {0, 5, 6}), false), ErrorCode::Value);
  EXPECT_EQ(sut.set(table_of({0, 1, 3}, {0, 5, HUGE_VAL}), false), ErrorCode::Value);
  EXPECT_NEAR(sut.at(0.5), 2.5, 1e-12);
}

TEST(CamTables, Know_how_far_they_go) {
  Cam sut;
  ASSERT_EQ(sut.set(table_of({0, 1, 2}, {0, 10, 0}), false), ErrorCode::Ok);
  EXPECT_NEAR(sut.extent().first, 0, 1e-9);
  EXPECT_NEAR(sut.extent().second, 10, 1e-9);
}

}  // namespace
}  // namespace indurop::robot
