// SPDX-License-Identifier: Apache-2.0
// Hulls, circles and rectangles against what trying all of them finds.
#include "tools/solids/planar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/tools/solids/bodies.h"

namespace indurop::solids {
namespace {

std::vector<Vec2> random_points(Chance& chance, int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double x = between(chance, -1, 1);
    points.emplace_back(x, between(chance, -1, 1));
  }
  return points;
}

bool holds_all(const Circle& circle, const std::vector<Vec2>& points) {
  return std::all_of(points.begin(), points.end(),
                     [&](const Vec2& point) { return (point - circle.middle).norm() <= circle.radius + 1e-9; });
}

// The smallest of the circles through two or three of the points that holds all.
double least_radius(const std::vector<Vec2>& points) {
  double least = 1e9;
  const auto look = [&](const Circle& circle) {
    if (circle.radius < least && holds_all(circle, points)) {
      least = circle.radius;
    }
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      look({(points[i] + points[j]) / 2, (points[i] - points[j]).norm() / 2});
      for (std::size_t k = 0; k < j; ++k) {
        Eigen::Matrix2d normals;
        normals << (points[j] - points[i]).transpose(), (points[k] - points[i]).transpose();
        const Vec2 sides((points[j].squaredNorm() - points[i].squaredNorm()) / 2,
                         (points[k].squaredNorm() - points[i].squaredNorm()) / 2);
        const Vec2 middle = normals.inverse() * sides;
        look({middle, (points[i] - middle).norm()});
      }
    }
  }
  return least;
}

TEST(Hulls, Are_around_all_points_and_made_of_them) {
  Chance chance(1);
  for (int round = 0; round < 100; ++round) {
    const std::vector<Vec2> points = random_points(chance, 3 + round % 20);
    const std::vector<Vec2> hull = hull_of(points);
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Vec2& from = hull[i];
      const Vec2 edge = hull[(i + 1) % hull.size()] - from;
      EXPECT_NE(std::find(points.begin(), points.end(), from), points.end());
      for (const Vec2& point : points) {
        EXPECT_GE(edge.x() * (point - from).y() - edge.y() * (point - from).x(), -1e-12);
      }
    }
  }
}

TEST(Hulls, Of_a_line_are_its_ends) {
  EXPECT_EQ(hull_of({{0, 0}, {2, 2}, {1, 1}, {2, 2}}), (std::vector<Vec2>{{0, 0}, {2, 2}}));
  EXPECT_EQ(hull_of({{3, 4}, {3, 4}}), (std::vector<Vec2>{{3, 4}}));
}

TEST(Least_circles, Are_as_small_as_the_best_of_all) {
  Chance chance(2);
  for (int round = 0; round < 200; ++round) {
    const std::vector<Vec2> points = random_points(chance, 2 + round % 12);
    const Circle circle = least_circle(points);
    EXPECT_TRUE(holds_all(circle, points));
    EXPECT_NEAR(circle.radius, least_radius(points), 1e-9);
  }
}

TEST(Least_circles, Of_points_on_a_line_reach_from_end_to_end) {
  const Circle circle = least_circle({{0, 0}, {1, 2}, {2, 4}, {1, 2}});
  EXPECT_NEAR(circle.radius, std::sqrt(5.0), 1e-12);
  EXPECT_EQ(least_circle({{7, 8}}).radius, 0);
}

TEST(Least_rectangles, Are_as_small_as_any_of_a_thousand_angles) {
  Chance chance(3);
  for (int round = 0; round < 50; ++round) {
    const std::vector<Vec2> points = random_points(chance, 3 + round % 12);
    double least = 1e9;
    for (int i = 0; i < 1000; ++i) {
      const Eigen::Rotation2Dd turn(robot::kPi / 2 * i / 1000);
      Eigen::AlignedBox2d extent;
      for (const Vec2& point : points) {
        extent.extend(Vec2(turn * point));
      }
      least = std::min(least, extent.volume());
    }
    EXPECT_LE(least_rectangle(hull_of(points)).area, least + 1e-12);
    EXPECT_GE(least_rectangle(hull_of(points)).area, 0.98 * least);
  }
}

}  // namespace
}  // namespace indurop::solids
