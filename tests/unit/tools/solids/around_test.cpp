// SPDX-License-Identifier: Apache-2.0
// Several solids around a surface: nothing of it, or of what it encloses, is outside of all of them.
#include "tools/solids/around.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/tools/solids/bodies.h"
#include "tools/solids/beyond.h"

namespace indurop::solids {
namespace {

const std::vector<Mat3> kStraight = {Mat3::Identity()};

bool held(const std::vector<Solid>& solids, const Vec3& point) {
  return std::any_of(solids.begin(), solids.end(), [&](const Solid& solid) { return holds(solid, point, 1e-9); });
}

double volume_of(const std::vector<Solid>& solids) {
  double volume = 0;
  for (const Solid& solid : solids) {
    volume += room_of(solid);
  }
  return volume;
}

Surface random_body(Chance& chance) {
  const Pose pose = pose_within(chance, 0.2);
  switch (std::uniform_int_distribution<int>(0, 2)(chance)) {
    case 0:
      return placed(box_surface(vector_between(chance, 0.05, 0.4)), pose);
    case 1:
      return placed(cylinder_surface(between(chance, 0.03, 0.1), between(chance, 0.1, 0.5), 20), pose);
    default:
      return placed(ball_surface(between(chance, 0.03, 0.15), 8), pose);
  }
}

TEST(Around, Holds_all_of_random_surfaces_and_of_what_is_inside) {
  Chance chance(1);
  for (int round = 0; round < 16; ++round) {
    SCOPED_TRACE(round);
    std::vector<Surface> bodies;
    Surface surface;
    for (int i = 0; i <= round % 4; ++i) {
      bodies.push_back(random_body(chance));
      add(surface, bodies.back());
    }
    const int most = 1 + round % 6;
    const auto solids = solids_around(surface, {0.001, most}, kStraight);
    EXPECT_LE(solids.size(), static_cast<std::size_t>(most));
    for (int i = 0; i < 500; ++i) {
      EXPECT_TRUE(held(solids, on_surface(chance, surface)));
      // Each body is convex: what is between two places of its surface is inside.
      const Surface& body = bodies[static_cast<std::size_t>(i) % bodies.size()];
      const double part = between(chance, 0, 1);
      const Vec3 inside = part * on_surface(chance, body) + (1 - part) * on_surface(chance, body);
      EXPECT_TRUE(held(solids, inside)) << inside.transpose();
    }
  }
}

TEST(Around, More_solids_never_take_more_room) {
  Chance chance(2);
  Surface surface = random_body(chance);
  add(surface, random_body(chance));
  add(surface, random_body(chance));
  double before = volume_of(solids_around(surface, {0.001, 1}, kStraight));
  for (const int most : {2, 4, 8}) {
    const double now = volume_of(solids_around(surface, {0.001, most}, kStraight));
    EXPECT_LE(now, 1.001 * before);
    before = now;
  }
}

TEST(Around, Cuts_an_angle_into_its_two_boxes) {
  Surface angle = placed(box_surface({0.4, 0.1, 0.1}), {{0.2, 0, 0}, robot::Quat::Identity()});
  add(angle, placed(box_surface({0.1, 0.1, 0.4}), {{0.05, 0, 0.15}, robot::Quat::Identity()}));
  const auto solids = solids_around(angle, {0.001, 2}, kStraight);
  ASSERT_EQ(solids.size(), 2U);
  EXPECT_NEAR(volume_of(solids) / (0.4 * 0.1 * 0.1 + 0.1 * 0.1 * 0.3), 1, 0.05);
  EXPECT_LT(beyond(solids, angle), 0.005);
}

TEST(Around, Cuts_an_elbow_into_its_two_tubes_and_the_corner) {
  const Pose lying{{0.2, 0, 0.4}, robot::from_rpy({0, robot::kPi / 2, 0})};
  Surface elbow = placed(cylinder_surface(0.05, 0.4), {{0, 0, 0.2}, robot::Quat::Identity()});
  add(elbow, placed(cylinder_surface(0.05, 0.4), lying));
  const double one = beyond(solids_around(elbow, {0.001, 1}, kStraight), elbow);
  const auto solids = solids_around(elbow, {0.001, 3}, kStraight);
  EXPECT_GT(one, 0.15);
  ASSERT_EQ(solids.size(), 3U);
  const auto tube = [](const Solid& solid) { return solid.kind == robot::SolidKind::Cylinder; };
  EXPECT_EQ(std::count_if(solids.begin(), solids.end(), tube), 2);
  EXPECT_LT(beyond(solids, elbow), 0.055);  // a corner of the box between them
}

TEST(Around, Leaves_whole_what_one_solid_fits) {
  EXPECT_EQ(solids_around(box_surface({0.2, 0.3, 0.4}), {}, kStraight).size(), 1U);
  EXPECT_EQ(solids_around(cylinder_surface(0.1, 0.4), {}, kStraight).size(), 1U);
}

TEST(Around, Takes_a_sheet_and_a_single_triangle) {
  const Surface triangle = {{Vec3(0, 0, 0), Vec3(0.3, 0, 0), Vec3(0, 0.2, 0.1)}};
  Chance chance(3);
  const auto solids = solids_around(triangle, {0.001, 4}, kStraight);
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(held(solids, on_surface(chance, triangle)));
  }
}

}  // namespace
}  // namespace indurop::solids
