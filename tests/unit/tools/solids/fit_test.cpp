// SPDX-License-Identifier: Apache-2.0
// Solids of least volume: bodies that are known, and random ones against ten thousand random directions.
#include "tools/solids/fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/tools/solids/bodies.h"
#include "tools/solids/beyond.h"
#include "tools/solids/cut.h"
#include "tools/solids/planar.h"

namespace indurop::solids {
namespace {

using robot::SolidKind;

const std::vector<Mat3> kUpright = {Mat3::Identity()};

void expect_all_held(const Solid& solid, const std::vector<Vec3>& points) {
  for (const Vec3& point : points) {
    EXPECT_TRUE(holds(solid, point, 1e-9));
  }
}

TEST(Fit, Finds_a_box_however_it_lies) {
  Chance chance(1);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const Vec3 edges = vector_between(chance, 0.05, 0.4);
    const auto points = corners_of(placed(box_surface(edges), pose_within(chance, 1)));
    const Solid found = fit(points, kUpright, {});
    ASSERT_EQ(found.kind, SolidKind::Box);
    EXPECT_NEAR(8 * found.half.prod() / edges.prod(), 1, 0.01);
  }
}

TEST(Fit, Finds_a_cylinder_however_it_lies) {
  Chance chance(2);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const double radius = between(chance, 0.03, 0.2);
    const double height = between(chance, 0.1, 0.5);
    const auto points = corners_of(placed(cylinder_surface(radius, height), pose_within(chance, 1)));
    const Solid found = fit(points, kUpright, {});
    ASSERT_EQ(found.kind, SolidKind::Cylinder);
    EXPECT_NEAR(found.half.x() / radius, 1, 0.01);
    EXPECT_NEAR(2 * found.half.z() / height, 1, 0.01);
  }
}

TEST(Fit, Finds_a_ball) {
  Chance chance(3);
  const auto points = corners_of(placed(ball_surface(0.12), pose_within(chance, 1)));
  const Solid found = fit(points, kUpright, {});
  ASSERT_EQ(found.kind, SolidKind::Ball);
  EXPECT_NEAR(found.half.x(), 0.12, 0.002);
}

TEST(Fit, Is_as_small_as_the_best_of_many_random_directions) {
  Chance chance(4);
  double worst = 0;
  for (int round = 0; round < 12; ++round) {
    std::vector<Vec3> points;
    const Pose pose = pose_within(chance, 1);
    const Vec3 size = vector_between(chance, 0.02, 0.3);
    for (int i = 0; i < 12; ++i) {
      points.emplace_back(pose.position + pose.orientation * vector_between(chance, -1, 1).cwiseProduct(size));
    }
    double least = 1e9;
    for (int i = 0; i < 10000; ++i) {
      const Mat3 frame = robot::from_rpy(vector_between(chance, -3.2, 3.2)).toRotationMatrix();
      least = std::min(least, room_of(fit_along(points, std::span(&frame, 1), {})));
    }
    worst = std::max(worst, room_of(fit(points, kUpright, {})) / least);
  }
  fmt::print("at most {:.3f} of the least that was found by chance\n", worst);
  EXPECT_LE(worst, 1.05);
}

TEST(Fit, Prefers_straight_ones_that_are_nearly_as_good) {
  // A straight box with one corner cut off a little.
  std::vector<Vec3> points = corners_of(box_surface({0.2, 0.3, 0.4}));
  points.emplace_back(0.1001, 0.02, 0.01);
  const Solid found = fit(points, kUpright, {});
  EXPECT_TRUE(found.place.orientation.isApprox(robot::Quat::Identity(), 1e-9));
}

TEST(Fit, Takes_sheets_lines_and_single_points) {
  const std::vector<Vec3> sheet = {{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.2, 0}, {0, 0.2, 0}};
  const Solid found = rounded(fit(sheet, kUpright, {}), sheet);
  EXPECT_EQ(found.kind, SolidKind::Box);
  EXPECT_NEAR(found.half.x() * found.half.y() * found.half.z(), 0.15 * 0.1 * 0.00005, 1e-7);
  const std::vector<Vec3> line = {{0, 0, 0}, {0.3, 0.3, 0.3}};
  expect_all_held(rounded(fit(line, kUpright, {}), line), line);
  const std::vector<Vec3> point = {{0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}};
  const Solid small = rounded(fit(point, kUpright, {}), point);
  expect_all_held(small, point);
  EXPECT_GT(small.half.minCoeff(), 0);
}

TEST(Rounded, Holds_all_points_with_numbers_of_a_file) {
  Chance chance(5);
  for (int round = 0; round < 100; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 8; ++i) {
      points.push_back(vector_between(chance, -0.4, 0.4));
    }
    const Solid solid = rounded(fit(points, kUpright, {}), points);
    expect_all_held(solid, points);
    const Vec3 edges = 2e4 * solid.half;
    EXPECT_TRUE((edges - Vec3(edges.array().round())).isZero(1e-6)) << edges.transpose();
    const Vec3 place = 1e5 * solid.place.position;
    EXPECT_TRUE((place - Vec3(place.array().round())).isZero(1e-6)) << place.transpose();
  }
}

}  // namespace
}  // namespace indurop::solids
