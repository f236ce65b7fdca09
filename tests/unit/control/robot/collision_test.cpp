// SPDX-License-Identifier: Apache-2.0
// Motions that would touch something do not begin: random arms, motions and zones against a second opinion, and what a
// a job and jogging report it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "control/robot/collision/collision_check.h"
#include "control/robot/plan/planner.h"
#include "group_cell.h"
#include "solid_reference.h"

namespace indurop::robot {
namespace {

constexpr double kMargin = 0.005;
constexpr ToolLimits kTool{1, 4, 40, kPi, 4 * kPi, 40 * kPi};

// An arm and its zones, as they are and as the reference has them.
class World {
 public:
  World(ReferenceArm arm, std::mt19937& random, int zones) : reference(std::move(arm)) {
    auto read = arm_from_urdf("any.urdf", reference.urdf());
    if (!read.ok()) {
      throw std::runtime_error(base::to_text(read.error()));
    }
    model = std::move(read).value();
    Bodies bodies;
    bodies.links = model.bodies;
    bodies.clearance = kMargin;
    solids_.reserve(static_cast<std::size_t>(zones));
    for (int i = 0; i < zones; ++i) {
      solids_.push_back(any_solid(random, 0.3));
      const ReferenceSolid& zone = solids_.back();
      Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
      frame.translate(2 * zone.origin + Vec3(0.3, 0, 0.2));
      frame.rotate(from_rpy(zone.rpy));
      zones_.push_back({&zone, frame});
      const Pose place{frame.translation(), Quat(frame.linear())};
      bodies.zones.push_back({"z" + std::to_string(i),
                              zone.kind == ReferenceSolid::Kind::Box ? Solid::box(zone.size, place)
                              : zone.kind == ReferenceSolid::Kind::Ball
                                  ? Solid::ball(zone.size[0], place)
                                  : Solid::cylinder(zone.size[0], zone.size[1], place),
                              -1});
    }
    places = std::make_unique<Places>(model.arm, inverse(), Workspace(), Clearance(model.arm, bodies));
    limits.velocity = model.velocity;
    limits.acceleration = limits.velocity / 0.25;
    limits.jerk = limits.acceleration / 0.1;
    planner = std::make_unique<Planner>(*places, limits, kTool);
  }
  const Inverse& inverse() {
    inverse_ = inverse_ ? std::move(inverse_) : std::make_unique<Inverse>(model.arm);
    return *inverse_;
  }
  Fault plan(const MoveCommand& command, const Joints& from) {
    Fault fault = planner->begin(command, from);
    while (fault.ok() && !planner->done()) {
      fault = planner->check(1000);
    }
    return fault;
  }
  // m that is left at least along it, from the second opinion; less the margin.
  [[nodiscard]] double room(const Joints& q) const { return reference.clearance(q, zones_) - kMargin; }
  [[nodiscard]] double room_along(const Segment& way, int parts) const {
    double least = HUGE_VAL;
    Joints q = way.from;
    for (int i = 0; i <= parts; ++i) {
      if (places->on(way, way.length * i / parts, q, q) != Reach::Ok) {
        ADD_FAILURE() << "there is no way";
        break;
      }
      least = std::min(least, room(q));
    }
    return least;
  }

  ReferenceArm reference;
  ArmModel model{cell_arm(), Joints::Ones()};
  JointLimits limits;
  std::unique_ptr<Places> places;
  std::unique_ptr<Planner> planner;

 private:
  std::vector<ReferenceSolid> solids_;
  std::vector<ReferencePlace> zones_;
  std::unique_ptr<Inverse> inverse_;
};

struct Count {
  int clear = 0, refused = 0;
};

// What is planned is clear, by the second opinion at many places; what is refused is not, or by a hair.
void judge(World& world, const MoveCommand& command, const Joints& from, Count& count) {
  constexpr double kHair = 1e-3;  // m
  static const int kPlaces = std::getenv("INDUROP_ROBOT_POSES") == nullptr ? 200 : 1000;
  const Fault fault = world.plan(command, from);
  Segment way = world.planner->segment();
  if (fault.ok()) {
    ++count.clear;
    if (command.move != Move::Joint || !way.together) {
      EXPECT_GE(world.room_along(way, kPlaces), -1e-6);
      return;
    }
    way.take_joint_timing({from, Joints::Zero(), Joints::Zero()}, world.limits, 1);
    EXPECT_GE(world.room_along(way, kPlaces), -1e-6);
    return;
  }
  if (fault.code != ErrorCode::Collision) {
    return;
  }
  ++count.refused;
  EXPECT_GE(fault.part, 0);
  EXPECT_LE(fault.part, 1);
  if (way.together) {
    way.take_joint_timing({from, Joints::Zero(), Joints::Zero()}, world.limits, 1);
  }
  EXPECT_LT(world.room_along(way, kPlaces), kHair);
}

Joints clear_place(World& world, std::mt19937& random) {
  for (int i = 0; i < 1000; ++i) {
    const Joints q = anywhere(world.model.arm, random);
    if (world.room(q) > 0.002) {
      return q;
    }
  }
  return Joints::Constant(NAN);
}

TEST(Collision, Joint_motions_of_any_arm_are_clear_or_refused) {
  std::mt19937 random(5);
  Count count;
  for (int round = 0; round < poses(12); ++round) {
    World world(ReferenceArm::any(random), random, static_cast<int>(random() % 3));
    for (int i = 0; i < 4; ++i) {
      const Joints from = clear_place(world, random);
      const Joints to = clear_place(world, random);
      if (!from.allFinite() || !to.allFinite() || !world.places->clearance().known()) {
        continue;
      }
      MoveCommand command;
      command.straight = i % 2 == 0;
      command.target.joints = to;
      SCOPED_TRACE(testing::Message() << round << " " << i);
      judge(world, command, from, count);
    }
  }
  EXPECT_GT(count.clear, poses(12) / 3);
  EXPECT_GT(count.refused, poses(12) / 3);
  std::printf("joint motions: %d clear, %d refused\n", count.clear, count.refused);
}

TEST(Collision, Lines_are_clear_or_refused) {
  std::mt19937 random(6);
  Count count;
  for (int round = 0; round < poses(8); ++round) {
    World world(ReferenceArm::usual(), random, 3);
    for (int i = 0; i < 10; ++i) {
      const Joints from = clear_place(world, random);
      if (!from.allFinite()) {
        continue;
      }
      MoveCommand command;
      command.move = Move::Line;
      command.target = pose_near(world.model.arm, from, 0.6, random);
      SCOPED_TRACE(testing::Message() << round << " " << i);
      judge(world, command, from, count);
    }
  }
  EXPECT_GT(count.clear, poses(8) / 3);
  EXPECT_GT(count.refused, poses(8) / 3);
  std::printf("lines: %d clear, %d refused\n", count.clear, count.refused);
}

// From one that was refused nothing is left behind; and a bend that would touch is not taken.
TEST(Collision, Bends_are_clear_or_left_out) {
  std::mt19937 random(7);
  int bent = 0;
  for (int round = 0; round < poses(12); ++round) {
    World world(ReferenceArm::usual(), random, 3);
    const Joints from = clear_place(world, random);
    if (!from.allFinite()) {
      continue;
    }
    MoveCommand command;
    command.move = Move::Line;
    command.zone = 0.1;
    command.target = pose_near(world.model.arm, from, 0.3, random);
    if (!world.plan(command, from).ok()) {
      continue;
    }
    const Segment first = world.planner->segment();
    command.target = pose_near(world.model.arm, first.to, 0.3, random);
    if (!world.plan(command, first.to).ok()) {
      continue;
    }
    const Segment second = world.planner->segment();
    const Blend blend = world.planner->blend(first, second);
    Joints q = first.to;
    for (int i = 0; i <= 500 && blend.zone > 0; ++i) {
      ASSERT_EQ(world.places->on(first, blend, second, blend.length() * i / 500, q, q), Reach::Ok);
      EXPECT_GE(world.room(q), -1e-6) << round;
    }
    bent += blend.zone > 0 ? 1 : 0;
  }
  EXPECT_GT(bent, poses(12) / 10);
}

}  // namespace
}  // namespace indurop::robot
