// SPDX-License-Identifier: Apache-2.0
// How far apart bodies are, and how far axes can move them, against a second opinion.

#include "control/robot/collision/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>

#include "control/robot/collision/body_distance.h"
#include "control/robot/files/read_bodies.h"
#include "robot_fixture.h"
#include "solid_reference.h"

namespace indurop::robot {
namespace {

Solid solid_of(const ReferenceSolid& from) {
  switch (from.kind) {
    case ReferenceSolid::Kind::Box:
      return Solid::box(from.size, {});
    case ReferenceSolid::Kind::Cylinder:
      return Solid::cylinder(from.size[0], from.size[1], {});
    case ReferenceSolid::Kind::Ball:
      break;
  }
  return Solid::ball(from.size[0], {});
}

PlacedSolid placed(const Solid& solid, const Eigen::Isometry3d& frame) {
  return {solid.kind, solid.half, frame.translation(), frame.linear()};
}

// FCL's line is the nearest one, and the planes across it are as far apart as the bodies.
TEST(Clearance, Distances_are_never_too_great_and_hardly_too_small) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> in(-1, 1);
  int apart = 0;
  int met = 0;
  int coarse = 0;
  for (int i = 0; i < poses(4000); ++i) {
    const ReferenceSolid a = any_solid(random, 0.4);
    const ReferenceSolid b = any_solid(random, 0.4);
    const auto frame = [&] {
      Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
      at.translate(Vec3(in(random), in(random), in(random)) * 0.5);
      at.rotate(Quat(in(random), in(random), in(random), in(random)).normalized());
      return at;
    };
    const ReferencePlace at_a{&a, frame()};
    const ReferencePlace at_b{&b, frame()};
    const double expected = reference_distance(at_a, at_b);
    const Solid one = solid_of(a);
    const Solid other = solid_of(b);
    Nearest sut({one, other});
    const PlacedSolid first = placed(one, at_a.frame);
    const PlacedSolid second = placed(other, at_b.frame);
    const double exact = sut.distance(0, 1, first, second);
    const double least = least_distance(first, second);
    EXPECT_LE(exact, expected + 1e-9) << i;
    EXPECT_LE(least, exact) << i;
    if (expected > 1e-3) {
      EXPECT_GT(exact, expected - 2e-3) << i;
      coarse += exact < expected - 1e-4 ? 1 : 0;
      EXPECT_GT(least, 0.3 * expected - 0.1) << i;
      ++apart;
    }
    met += expected < 1e-9 ? 1 : 0;
  }
  EXPECT_GT(apart, poses(4000) / 5);
  EXPECT_LT(coarse, poses(4000) / 200 + 1);
  EXPECT_GT(met, poses(4000) / 50);
}

// Seen from the other body, no corner goes farther than the lever says.
TEST(Clearance, No_point_goes_farther_than_its_lever) {
  std::mt19937 random(2);
  for (int round = 0; round < poses(12); ++round) {
    const ReferenceArm arm = ReferenceArm::any(random);
    const auto model = arm_from_urdf("any.urdf", arm.urdf());
    ASSERT_TRUE(model.ok()) << base::to_text(model.error());
    Bodies bodies;
    bodies.links = model->bodies;
    const Clearance sut(model->arm, bodies);
    for (int i = 0; i < 40; ++i) {
      const Joints q = anywhere(model->arm, random, 0.01);
      Joints far = q;
      for (int k = 0; k < model->arm.count(); ++k) {
        far[k] += 1e-4 * std::uniform_real_distribution<double>(-1, 1)(random);
      }
      const auto before = arm.places(q);
      const auto behind = arm.places(far);
      for (const Clearance::Pair& pair : sut.pairs()) {
        const auto a = static_cast<std::size_t>(sut.parts()[static_cast<std::size_t>(pair.a)].joint);
        const auto b = static_cast<std::size_t>(sut.parts()[static_cast<std::size_t>(pair.b)].joint);
        const double most = pair.lever.dot((far - q).cwiseAbs());
        for (int corner = 0; corner < 8; ++corner) {
          const ReferenceSolid& solid = *before[b].solid;
          const Vec3 outside((corner & 1) != 0 ? 9 : -9, (corner & 2) != 0 ? 9 : -9, (corner & 4) != 0 ? 9 : -9);
          const Vec3 point = solid.nearest(outside);
          const Vec3 from = before[a].frame.inverse() * before[b].frame * point;
          const Vec3 to = behind[a].frame.inverse() * behind[b].frame * point;
          EXPECT_LE((to - from).norm(), most * (1 + 1e-3) + 1e-12) << round << " " << a << " " << b;
        }
      }
    }
  }
}

TEST(Clearance, Says_what_is_kept_apart_and_what_is_not) {
  ReferenceArm arm = ReferenceArm::usual();
  arm.solids[6].size[0] = 0.26;
  auto model = arm_from_urdf("usual.urdf", arm.urdf());
  ASSERT_TRUE(model.ok());
  Bodies bodies;
  bodies.links = model->bodies;
  bodies.zones = {{"table", Solid::box({1, 1, 0.1}, {{0.8, 0, -0.1}, Quat::Identity()}), -1}};
  bodies.tools = {{"pen", Solid::cylinder(0.01, 0.2, {{0, 0, 0.1}, Quat::Identity()}), 1}};
  bodies.ignored = {{"table", "link1"}, {"link0", "link2"}};
  bodies.clearance = 0.005;
  const std::string text = Clearance(model->arm, bodies).text();
  EXPECT_NE(text.find("link0 - link3"), std::string::npos) << text;
  EXPECT_NE(text.find("link2 - table"), std::string::npos) << text;
  EXPECT_NE(text.find("pen - table"), std::string::npos) << text;
  EXPECT_EQ(text.find("link1 - link2"), std::string::npos) << text;
  EXPECT_NE(text.find("may touch (ignore_collisions): link0 - link2, link1 - table"), std::string::npos) << text;
  EXPECT_NE(text.find("touch with all joints at zero: link4 - link6"), std::string::npos) << text;
}

// As often as the second opinion finds it, but for those that are about a quarter.
TEST(Clearance, Says_what_is_too_near_nearly_everywhere) {
  constexpr int kPlaces = 400;
  std::mt19937 random(4);
  int found_close = 0;
  int free = 0;
  for (int round = 0; round < poses(12); ++round) {
    const ReferenceArm arm = ReferenceArm::any(random);
    const auto model = arm_from_urdf("any.urdf", arm.urdf());
    ASSERT_TRUE(model.ok()) << base::to_text(model.error());
    Bodies bodies;
    bodies.links = model->bodies;
    bodies.clearance = 0.005;
    const Clearance sut(model->arm, bodies);
    const std::string said = base::to_text(check_room(model->arm, sut, "any.urdf"));
    std::map<std::string, int> near;
    for (int i = 0; i < kPlaces; ++i) {
      const auto places = arm.places(anywhere(model->arm, random, 0));
      for (const Clearance::Pair& pair : sut.pairs()) {
        const auto a = static_cast<std::size_t>(sut.parts()[static_cast<std::size_t>(pair.a)].joint);
        const auto b = static_cast<std::size_t>(sut.parts()[static_cast<std::size_t>(pair.b)].joint);
        near["link 'link" + std::to_string(b) + "' and link 'link" + std::to_string(a) + "' are too near"] +=
            reference_distance(places[a], places[b]) < bodies.clearance ? 1 : 0;
      }
    }
    for (const auto& [words, count] : near) {
      const bool found = said.find("any.urdf:1:1: warning: " + words) != std::string::npos;
      EXPECT_TRUE(found || count < 0.35 * kPlaces) << words << " " << count;
      EXPECT_TRUE(!found || count > 0.12 * kPlaces) << words << " " << count;
      found_close += found ? 1 : 0;
      free += found ? 0 : 1;
    }
  }
  EXPECT_GT(found_close, 0);
  EXPECT_GT(free, found_close);
}

TEST(Clearance, An_invalid_body_is_reported_with_its_line) {
  std::string text = ReferenceArm::usual().urdf();
  const auto with = [&](const std::string& geometry) {
    std::string changed = text;
    const std::size_t at = changed.find("<cylinder radius='0.055");
    changed.replace(at, changed.find("/>", at) + 2 - at, geometry);
    return arm_from_urdf("a.urdf", changed);
  };
  const auto mesh = with("<mesh filename='package://arm/forearm.dae'/>");
  ASSERT_TRUE(mesh.ok()) << base::to_text(mesh.error());
  ASSERT_FALSE(mesh->notes.empty());
  EXPECT_EQ(base::to_string(mesh->notes.back()).find("a.urdf:6:20: warning: link 'link4': this mesh is not checked"),
            0U)
      << base::to_string(mesh->notes.back());
  const auto flat = with("<box size='0.1 0 0.1'/>");
  ASSERT_FALSE(flat.ok());
  EXPECT_EQ(base::to_string(flat.error().at(0)),
            "a.urdf:6:20: error: link 'link4': all sizes of a body have to be above 0 (m)");
}

}  // namespace
}  // namespace indurop::robot
