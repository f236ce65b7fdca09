// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/inverse.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

TEST(Inverse, Knows_which_arms_have_a_closed_form) {
  const Arm straight = cell_arm();
  const Arm odd = odd_arm();
  EXPECT_TRUE(Inverse(straight).closed_form());
  EXPECT_FALSE(Inverse(odd).closed_form());
}

TEST(Inverse, All_solutions_over_the_workspace_reach_the_pose) {
  const Arm arm = cell_arm();
  const Inverse sut(arm);
  std::mt19937 random(5);
  int solutions = 0;
  for (int i = 0; i < 20000; ++i) {
    const Joints q = anywhere(arm, random);
    const Pose pose = arm.forward(q);
    const Solutions found = sut.all(pose, q);
    ASSERT_GT(found.count, 0) << q.transpose();
    double nearest = HUGE_VAL;
    for (int k = 0; k < found.count; ++k) {
      const Solution& one = found.list[static_cast<std::size_t>(k)];
      EXPECT_LT(distance(arm.forward(one.q), pose), 1e-6) << one.q.transpose();
      EXPECT_EQ(arm.beyond_limits(one.q), -1);
      nearest = std::min(nearest, (one.q - q).norm());
    }
    EXPECT_LT(nearest, 1e-5) << q.transpose();
    solutions += found.count;
  }
  EXPECT_GT(solutions, 2 * 20000);  // limits leave more than two on average
}

TEST(Inverse, Eight_postures_where_limits_allow_them) {
  Arm arm = cell_arm();
  std::array<Axis, kAxes> axes;
  for (int i = 0; i < kAxes; ++i) {
    axes[static_cast<std::size_t>(i)] = arm.axis(i);
    axes[static_cast<std::size_t>(i)].endless = true;
  }
  arm = Arm(axes, arm.home());
  const Inverse sut(arm);
  const Joints q = joints_of({0.4, 0.5, -0.3, 0.6, 0.8, -0.2});
  const Solutions found = sut.all(arm.forward(q), q);
  ASSERT_EQ(found.count, 8);
  unsigned seen = 0;
  for (int i = 0; i < found.count; ++i) {
    const Solution& one = found.list[static_cast<std::size_t>(i)];
    seen |= 1U << one.posture;
    EXPECT_LT(distance(arm.forward(one.q), arm.forward(q)), 1e-6);
  }
  EXPECT_EQ(seen, 0xFFU);
}

TEST(Inverse, The_solution_nearest_to_where_the_arm_is) {
  const Arm arm = cell_arm();
  const Inverse sut(arm);
  std::mt19937 random(6);
  for (int i = 0; i < 3000; ++i) {
    const Joints q = anywhere(arm, random, 0.1);
    if (std::abs(q[4]) < 0.02) {
      continue;  // near a singular position small steps of the tool are large ones of the wrist
    }
    Joints close = q;
    close.array() += 0.001;
    const auto found = sut.nearest(arm.forward(q), close);
    ASSERT_EQ(found.reach, Reach::Ok);
    EXPECT_LT((found.solution.q - q).norm(), 1e-4);
  }
}

TEST(Inverse, Posture_can_be_chosen) {
  const Arm arm = cell_arm();
  const Inverse sut(arm);
  const Joints q = joints_of({0.2, 0.4, 0.1, 0.3, 0.7, 0.1});
  const Pose pose = arm.forward(q);
  const auto here = sut.nearest(pose, q);
  const auto flipped = sut.nearest(pose, q, static_cast<std::uint8_t>(here.solution.posture ^ Solution::kWrist));
  ASSERT_EQ(flipped.reach, Reach::Ok);
  EXPECT_LT(flipped.solution.q[4] * q[4], 0);
  EXPECT_LT(distance(arm.forward(flipped.solution.q), pose), 1e-6);
}

TEST(Inverse, Singular_wrist_keeps_the_joint_as_it_is) {
  const Arm arm = cell_arm();
  const Inverse sut(arm);
  const Joints q = joints_of({0.3, 0.5, -0.2, 0.9, 0, 0.4});
  const auto found = sut.nearest(arm.forward(q), q);
  ASSERT_EQ(found.reach, Reach::Ok);
  EXPECT_NEAR(found.solution.q[3], 0.9, 1e-6);
  EXPECT_NEAR(found.solution.q[5], 0.4, 1e-6);
}

// Where axes 4 and 6 nearly share a line their angles are as uncertain as rounding divided by the sine of axis 5, not
// by its square: noise there is motion of the drives.
TEST(Inverse, Rounds_no_more_than_it_must_near_a_straight_wrist) {
  const Arm arm = cell_arm();
  const Inverse sut(arm);
  std::mt19937 random(8);
  for (int i = 0; i < 5000; ++i) {
    Joints q = anywhere(arm, random, 0.1);
    q[1] *= 0.2;  // far from the other singular positions
    q[2] *= 0.2;
    q[4] = std::copysign(std::pow(10, std::uniform_real_distribution<double>(-6.5, -1)(random)), q[4]);
    const auto found = sut.nearest(arm.forward(q), q);
    ASSERT_EQ(found.reach, Reach::Ok);
    const double rounding = 1e-14 / std::abs(q[4]);
    EXPECT_LT(std::abs(found.solution.q[3] - q[3]), rounding) << q.transpose();
    EXPECT_LT(std::abs(found.solution.q[5] - q[5]), rounding) << q.transpose();
    EXPECT_LT(std::abs(found.solution.q[4] - q[4]), 1e-14) << q.transpose();
  }
}

TEST(Inverse, Says_whether_reach_or_limits_are_in_the_way) {
  const Arm arm = cell_arm();
  const Inverse sut(arm);
  const Joints near = Joints::Zero();
  Pose far = arm.forward(near);
  far.position.x() += 3;
  EXPECT_EQ(sut.nearest(far, near).reach, Reach::OutOfReach);
  // To the side of an arm that cannot turn there, neither in front nor over its back.
  std::array<Axis, kAxes> axes;
  for (int i = 0; i < kAxes; ++i) {
    axes[static_cast<std::size_t>(i)] = arm.axis(i);
  }
  axes[0].lower = -1;
  axes[0].upper = 1;
  const Arm narrow(axes, arm.home());
  const Joints q = joints_of({1.5, 0.3, 0.2, 0, 1.0, 0});
  EXPECT_EQ(Inverse(narrow).nearest(arm.forward(q), near).reach, Reach::JointLimit);
}

TEST(Inverse, Numeric_solution_of_arms_without_closed_form) {
  const Arm arm = odd_arm();
  std::mt19937 random(7);
  int found = 0;
  constexpr int kTries = 500;
  for (int i = 0; i < kTries; ++i) {
    const Joints q = anywhere(arm, random, 0.3);
    Joints near = q;
    near.array() += 0.15;
    const auto result = solve_numerically(arm, arm.forward(q), near);
    if (result.reach == Reach::Ok) {
      ++found;
      EXPECT_LT(distance(arm.forward(result.q), arm.forward(q)), 1e-6);
      EXPECT_EQ(arm.beyond_limits(result.q), -1);
    }
  }
  EXPECT_GT(found, kTries * 95 / 100);
}

TEST(Inverse, Numeric_solution_gives_up_on_what_cannot_be_reached) {
  const Arm arm = odd_arm();
  Pose far = arm.forward(Joints::Zero());
  far.position.z() += 5;
  EXPECT_NE(solve_numerically(arm, far, Joints::Zero()).reach, Reach::Ok);
}

}  // namespace
}  // namespace indurop::robot
