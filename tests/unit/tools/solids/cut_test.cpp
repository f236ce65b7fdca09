// SPDX-License-Identifier: Apache-2.0
// What a plane makes of surfaces.
#include "tools/solids/cut.h"

#include <gtest/gtest.h>

#include "tests/unit/tools/solids/bodies.h"
#include "tools/solids/beyond.h"

namespace indurop::solids {
namespace {

double area_of(const Surface& surface) {
  double area = 0;
  for (const Triangle& triangle : surface) {
    area += (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm() / 2;
  }
  return area;
}

TEST(Cut, Of_a_box_gives_two_closed_boxes) {
  const Parts parts = cut(box_surface({0.2, 0.3, 0.4}), {Vec3::UnitX(), 0.05});
  EXPECT_NEAR(area_of(parts.below), 2 * (0.15 * 0.3 + 0.15 * 0.4 + 0.3 * 0.4), 1e-12);
  EXPECT_NEAR(area_of(parts.above), 2 * (0.05 * 0.3 + 0.05 * 0.4 + 0.3 * 0.4), 1e-12);
}

TEST(Cut, Through_a_hollow_makes_a_lid_over_it) {
  // A tube: the lid is a full square.
  Surface tube = box_surface({0.2, 0.2, 0.4});
  add(tube, box_surface({0.1, 0.1, 0.4}));
  const Parts parts = cut(tube, {Vec3::UnitZ(), 0});
  EXPECT_NEAR(area_of(parts.below) + area_of(parts.above) - area_of(tube), 2 * 0.2 * 0.2, 1e-12);
}

TEST(Cut, Next_to_a_surface_leaves_it_whole) {
  const Surface box = box_surface({0.2, 0.3, 0.4});
  const Parts parts = cut(box, {Vec3::UnitX(), 0.2});
  EXPECT_EQ(parts.below.size(), box.size());
  EXPECT_TRUE(parts.above.empty());
}

TEST(Cut, Loses_nothing_of_random_bodies) {
  Chance chance(1);
  for (int round = 0; round < 40; ++round) {
    Surface body = placed(box_surface(vector_between(chance, 0.1, 0.5)), pose_within(chance, 0.2));
    add(body, placed(cylinder_surface(0.1, 0.4, 12), pose_within(chance, 0.2)));
    const Plane plane{vector_between(chance, -1, 1).normalized(), between(chance, -0.2, 0.2)};
    const Parts parts = cut(body, plane);
    for (const auto& [part, side] : {std::pair(&parts.below, 1.0), std::pair(&parts.above, -1.0)}) {
      for (const Vec3& corner : corners_of(*part)) {
        EXPECT_LE(side * (corner.dot(plane.normal) - plane.at), 1e-12);
      }
    }
    for (int i = 0; i < 50; ++i) {
      const Vec3 point = on_surface(chance, body);
      const Surface& there = point.dot(plane.normal) < plane.at ? parts.below : parts.above;
      EXPECT_LT(distance_to(there, point), 1e-9);
    }
    // The same corners, but for those of the lids, which are at the rims.
    const PartCorners corners = corners_after(body, plane);
    EXPECT_EQ(corners.below.empty(), parts.below.empty());
    for (const Vec3& corner : corners.below) {
      EXPECT_LT(distance_to(parts.below, corner), 1e-9);
    }
  }
}

}  // namespace
}  // namespace indurop::solids
