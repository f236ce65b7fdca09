// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/delta.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "control/robot/kinematics/abilities.h"
#include "control/robot/kinematics/inverse.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

constexpr double kBase = 0.2, kUpper = 0.235, kLower = 0.8, kPlatform = 0.045, kTool = 0.03;

// The other way round, as textbooks have it: the angle of one arm from the tool's point.
double angle_of_arm(int i, const Vec3& tool) {
  const Vec3 p = Eigen::AngleAxisd(-2 * kPi / 3 * i, Vec3::UnitZ()) * (tool + Vec3(0, 0, kTool));
  const double out = p.x() + kPlatform - kBase;
  const double a = out;
  const double b = -p.z();
  const double c = (p.squaredNorm() - p.x() * p.x() + out * out + kUpper * kUpper - kLower * kLower) / (2 * kUpper);
  // a cos q + b sin q = c, the knee outside
  return std::atan2(b, a) - std::acos(c / std::hypot(a, b));
}

TEST(Delta, Angles_from_the_textbook_lead_to_the_point) {
  const Arm sut = arm_of("delta");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> side(-0.2, 0.2);
  std::uniform_real_distribution<double> down(-0.9, -0.75);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 point(side(random), side(random), down(random));
    const Joints q = joints_of({angle_of_arm(0, point), angle_of_arm(1, point), angle_of_arm(2, point), 0.4});
    ASSERT_LT((sut.forward(q).position - point).norm(), 1e-12) << point.transpose();
  }
}

TEST(Delta, Jacobian_is_the_derivative_of_forward_kinematics) {
  const Arm sut = arm_of("delta");
  std::mt19937 random(2);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 100; ++i) {
    Joints q = anywhere(sut, random, 0.2);
    const Jacobian j = sut.jacobian(q);
    for (int k = 0; k < kAxes; ++k) {
      Joints there = q;
      Joints back = q;
      there[k] += kStep;
      back[k] -= kStep;
      const Twist expected = difference(sut.forward(back), sut.forward(there)) / (2 * kStep);
      ASSERT_LT((j.col(k) - expected).norm(), 1e-6) << k;
    }
  }
}

TEST(Delta, Poses_made_of_joints_are_found_again) {
  const Arm arm = arm_of("delta");
  const Inverse sut(arm);
  std::mt19937 random(3);
  const int count = poses(300);
  int reached = 0;
  double worst = 0;
  for (int i = 0; i < count; ++i) {
    const Pose pose = arm.forward(anywhere(arm, random));
    const Solutions found = sut.search(pose, Joints::Zero(), {.least = 1});
    reached += found.count > 0 ? 1 : 0;
    if (found.count > 0) {
      worst = std::max(worst, distance(arm.forward(found.list[0].q), pose));
    }
  }
  fmt::print("delta: {} of {} found, {:.1e} off at most\n", reached, count, worst);
  EXPECT_LT(worst, 1e-9);
  EXPECT_GE(reached, count * 999 / 1000);
}

TEST(Delta, Says_what_it_can_do) {
  const Arm arm = arm_of("delta");
  EXPECT_EQ(abilities(arm, Inverse(arm)),
            "4 axes, inverse kinematics step by step; poses: x y z and turns about (0 0 1) of the base; no postures");
}

TEST(Delta, Errors_say_what_is_missing) {
  const auto errors = [](const std::string& element) {
    const auto model = arm_from_urdf("d.urdf", "<robot name='d'><link name='base'/>\n" + element + "</robot>");
    return base::to_text(model.error());
  };
  EXPECT_NE(errors("<delta base='1'/>").find("d.urdf:2:1: error: <delta> needs upper=\"...\", a length above 0 (m)"),
            std::string::npos);
  EXPECT_NE(errors("<delta arms='a'/>").find("names the joint 'a', which does not turn or is not there"),
            std::string::npos);
}

}  // namespace
}  // namespace indurop::robot
