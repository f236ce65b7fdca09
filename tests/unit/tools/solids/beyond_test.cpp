// SPDX-License-Identifier: Apache-2.0
// Distances of points to surfaces, what is inside, and how far solids reach beyond.
#include "tools/solids/beyond.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/tools/solids/bodies.h"

namespace indurop::solids {
namespace {

using robot::Solid;

TEST(Distance_to, Is_that_of_a_box_by_its_formula) {
  Chance chance(1);
  const Vec3 edges(0.2, 0.3, 0.4);
  const Pose pose = pose_within(chance, 0.3);
  const Surface box = placed(box_surface(edges), pose);
  for (int i = 0; i < 500; ++i) {
    const Vec3 there = vector_between(chance, -0.5, 0.5);
    const Vec3 over = there.cwiseAbs() - edges / 2;
    const bool inside = over.maxCoeff() < 0;
    const double expected = inside ? -over.maxCoeff() : over.cwiseMax(0).norm();
    const Vec3 point = pose.position + pose.orientation * there;
    EXPECT_NEAR(distance_to(box, point), expected, 1e-9);
    EXPECT_EQ(inside_of(box, point), inside);
    EXPECT_EQ(holds(Solid::box(edges, pose), point), inside);
  }
}

TEST(Distance_to, Takes_triangles_without_area) {
  const Surface line = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 0, 0)}};
  EXPECT_NEAR(distance_to(line, {0.25, 0.3, 0.4}), 0.5, 1e-12);
  const Surface point = {{Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)}};
  EXPECT_NEAR(distance_to(point, {1, 2, 5}), 2, 1e-12);
}

TEST(Inside_of, Does_not_depend_on_which_side_the_triangles_show) {
  Surface ball = ball_surface(0.2);
  EXPECT_TRUE(inside_of(ball, {0.05, 0.1, 0}));
  for (Triangle& triangle : ball) {
    std::swap(triangle[0], triangle[1]);
  }
  EXPECT_TRUE(inside_of(ball, {0.05, 0.1, 0}));
  EXPECT_FALSE(inside_of(ball, {0.15, 0.15, 0}));
}

TEST(Skin_of, Is_on_the_solid_and_has_its_corners) {
  Chance chance(2);
  const Pose pose = pose_within(chance, 0.3);
  for (const Solid& solid :
       {Solid::box({0.2, 0.3, 0.4}, pose), Solid::cylinder(0.1, 0.3, pose), Solid::ball(0.2, pose)}) {
    double farthest = 0;
    for (const Vec3& point : skin_of(solid)) {
      EXPECT_TRUE(holds(solid, point, 1e-9));
      EXPECT_FALSE(holds(solid, point, -1e-9));
      farthest = std::max(farthest, (point - pose.position).norm());
    }
    EXPECT_NEAR(farthest, solid.radius(), 1e-9);
  }
}

TEST(Beyond, Is_how_far_a_corner_stands_out) {
  const Surface box = box_surface({0.2, 0.2, 0.2});
  EXPECT_NEAR(beyond({Solid::box({0.2, 0.2, 0.2}, {})}, box), 0, 1e-9);
  EXPECT_NEAR(beyond({Solid::box({0.22, 0.24, 0.24}, {})}, box), 0.03, 1e-9);  // by 1, 2 and 2 cm
  // What is hidden in another solid does not count, nor what is inside.
  EXPECT_NEAR(beyond({Solid::box({0.2, 0.2, 0.2}, {}), Solid::ball(0.05, {})}, box), 0, 1e-9);
}

}  // namespace
}  // namespace indurop::solids
