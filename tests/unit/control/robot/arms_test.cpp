// SPDX-License-Identifier: Apache-2.0
// Arms of all kinds, from tests/unit/control/robot/arms: forward kinematics as orocos-kdl has it, and joint angles
// anywhere within the limits are found again from the pose alone. INDUROP_ROBOT_POSES says how many poses of each arm.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <vector>

#include "control/robot/kinematics/inverse.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

struct Row {
  double a, alpha, d;
};

struct KnownArm {
  const char* file;
  std::vector<Row> rows;  // Denavit-Hartenberg, as published
};

const KnownArm kCobots[] = {
    {"ur5",
     {{0, kPi / 2, 0.089159},
      {-0.425, 0, 0},
      {-0.39225, 0, 0},
      {0, kPi / 2, 0.10915},
      {0, -kPi / 2, 0.09465},
      {0, 0, 0.0823}}},
    {"ur10",
     {{0, kPi / 2, 0.1273},
      {-0.612, 0, 0},
      {-0.5723, 0, 0},
      {0, kPi / 2, 0.163941},
      {0, -kPi / 2, 0.1157},
      {0, 0, 0.0922}}},
    {"ur3e",
     {{0, kPi / 2, 0.15185},
      {-0.24355, 0, 0},
      {-0.2132, 0, 0},
      {0, kPi / 2, 0.13105},
      {0, -kPi / 2, 0.08535},
      {0, 0, 0.0921}}},
};

Pose arm_by_kdl(const KnownArm& known, const Joints& q) {
  KDL::Chain chain;
  for (const Row& row : known.rows) {
    chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(row.a, row.alpha, row.d, 0)));
  }
  KDL::JntArray joints(static_cast<unsigned>(known.rows.size()));
  for (unsigned i = 0; i < known.rows.size(); ++i) {
    joints(i) = q[static_cast<int>(i)];
  }
  KDL::Frame frame;
  EXPECT_GE(KDL::ChainFkSolverPos_recursive(chain).JntToCart(joints, frame), 0);
  Pose pose;
  pose.position = Vec3(frame.p.x(), frame.p.y(), frame.p.z());
  Quat& turn = pose.orientation;
  frame.M.GetQuaternion(turn.x(), turn.y(), turn.z(), turn.w());
  return pose;
}

TEST(Arms, Forward_kinematics_agrees_with_KDL) {
  for (const KnownArm& known : kCobots) {
    const Arm sut = arm_of(known.file);
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
      const Joints q = anywhere(sut, random);
      ASSERT_LT(distance(sut.forward(q), arm_by_kdl(known, q)), 1e-9) << known.file << " " << q.transpose();
    }
  }
}

struct Found {
  int reached = 0;   // poses with a solution
  int same = 0;      // among the solutions are the angles the pose was made of, up to whole turns
  int held = 0;      // asking for their posture gives them or others of that posture
  double worst = 0;  // from the pose
};

double turns_away(const Joints& a, const Joints& b) {
  return (a - b).unaryExpr([](double v) { return std::remainder(v, 2 * kPi); }).cwiseAbs().maxCoeff();
}

Found find_again(const Arm& arm, int count, const Search& how = {}) {
  const Inverse sut(arm);
  std::mt19937 random(2);
  Found all;
  for (int i = 0; i < count; ++i) {
    const Joints q = anywhere(arm, random);
    const Pose pose = arm.forward(q);
    const Joints near = anywhere(arm, random);
    const Solutions found = sut.search(pose, near, how);
    all.reached += found.count > 0 ? 1 : 0;
    bool same = false;
    for (int k = 0; k < found.count; ++k) {
      const Solution& one = found.list[static_cast<std::size_t>(k)];
      all.worst = std::max(all.worst, distance(arm.forward(one.q), pose));
      EXPECT_EQ(arm.beyond_limits(one.q), -1);
      if (turns_away(one.q, q) < 1e-4) {
        same = true;
        const Solution* held = found.nearest(near, one.posture);
        all.held += held != nullptr && held->posture == one.posture ? 1 : 0;
      }
    }
    all.same += same ? 1 : 0;
  }
  return all;
}

TEST(Arms, Closed_forms_find_every_pose) {
  const auto find = [](const char* name, const Arm& arm) {
    ASSERT_TRUE(Inverse(arm).closed_form());
    const int count = poses(2000);
    const Found found = find_again(arm, count);
    fmt::print("{}: {} of {} found, {} times the same angles, {:.1e} off at most\n", name, found.reached, count,
               found.same, found.worst);
    EXPECT_EQ(found.reached, count) << name;
    EXPECT_GE(found.same, count * 999 / 1000) << name;
    EXPECT_LT(found.worst, 1e-9) << name;
  };
  find("spherical wrist", cell_arm());
  for (const KnownArm& known : kCobots) {
    find(known.file, arm_of(known.file));
  }
}

// Most are left out on the way to the nearest one.
TEST(Arms, The_nearest_solution_is_the_nearest_of_all) {
  for (const Arm& arm : {cell_arm(), arm_of("ur5"), arm_of("ur3e")}) {
    const Inverse sut(arm);
    std::mt19937 random(6);
    for (int i = 0; i < poses(2000); ++i) {
      Joints q = anywhere(arm, random);
      const bool straight = i % 10 == 0;  // the wrist of both kinds
      q[4] = straight ? 0 : q[4];
      const Joints near = i % 2 == 0 ? anywhere(arm, random) : q + 0.01 * Joints::Random();
      const Pose pose = arm.forward(q);
      const Solutions all = sut.all(pose, near);
      const Solution* wanted = all.nearest(near, std::nullopt);
      const auto found = sut.nearest(pose, near);
      ASSERT_EQ(found.reach == Reach::Ok, wanted != nullptr);
      if (wanted != nullptr) {
        ASSERT_NEAR((found.solution.q - near).norm(), (wanted->q - near).norm(), 1e-9);
        ASSERT_LT(distance(arm.forward(found.solution.q), pose), straight ? 1e-6 : 1e-9);
      }
    }
  }
}

TEST(Arms, Eight_postures_of_parallel_axes_are_distinguished) {
  const Arm arm = arm_of("ur5");
  const Inverse sut(arm);
  Joints q = Joints::Zero();
  q.head<6>() << 0.4, -1.1, 1.3, -0.6, 0.8, -0.2;
  const Solutions found = sut.all(arm.forward(q), q);
  ASSERT_EQ(found.count, 8);
  unsigned seen = 0;
  for (int i = 0; i < found.count; ++i) {
    const Solution& one = found.list[static_cast<std::size_t>(i)];
    seen |= 1U << one.posture;
    EXPECT_EQ(one.posture, Postures::of(arm)->at(arm, one.q));
  }
  EXPECT_EQ(seen, 0xFFU);
}

TEST(Arms, Postures_derived_from_angles_are_those_of_the_closed_forms) {
  for (const Arm& arm : {cell_arm(), arm_of("ur10")}) {
    const Inverse sut(arm);
    const auto postures = Postures::of(arm);
    ASSERT_TRUE(postures.has_value());
    std::mt19937 random(3);
    for (int i = 0; i < 500; ++i) {
      const Joints q = anywhere(arm, random, 0.1);
      const Solutions found = sut.all(arm.forward(q), q);
      for (int k = 0; k < found.count; ++k) {
        const Solution& one = found.list[static_cast<std::size_t>(k)];
        EXPECT_EQ(one.posture, postures->at(arm, one.q)) << one.q.transpose();
      }
    }
  }
}

TEST(Arms, Singular_wrist_of_parallel_axes_keeps_the_last_joint) {
  const Arm arm = arm_of("ur5");
  Joints q = Joints::Zero();
  q.head<6>() << 0.3, -1.0, 1.2, 0.4, 0, 0.7;
  const auto found = Inverse(arm).nearest(arm.forward(q), q);
  ASSERT_EQ(found.reach, Reach::Ok);
  EXPECT_LT((found.solution.q - q).norm(), 1e-6);
}

TEST(Arms, Search_finds_the_poses_of_an_arm_without_closed_form) {
  for (const Arm& arm : {odd_arm(), arm_of("offset_wrist")}) {
    ASSERT_FALSE(Inverse(arm).closed_form());
    const int count = poses(2000);
    const Found found = find_again(arm, count, {.least = 1});
    fmt::print("step by step: {} of {} found, {:.1e} off at most\n", found.reached, count, found.worst);
    EXPECT_GE(found.reached, count * 999 / 1000);
    EXPECT_LT(found.worst, 1e-9);
    constexpr int kFew = 200;  // where all ways are searched for
    const Found all = find_again(arm, kFew);
    fmt::print("{} of {} found, {} times the same angles\n", all.reached, kFew, all.same);
    EXPECT_EQ(all.reached, kFew);
    EXPECT_GE(all.same, kFew * 95 / 100);
  }
}

}  // namespace
}  // namespace indurop::robot
