// SPDX-License-Identifier: Apache-2.0
#include "control/robot/kinematics/arm.h"

#include <gtest/gtest.h>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

// The same arm typed in again, for another library.
KDL::Chain kdl_arm() {
  using KDL::Frame;
  using KDL::Joint;
  using KDL::Vector;
  KDL::Chain chain;
  const auto add = [&](Joint::JointType kind, const Vector& before) {
    chain.addSegment(KDL::Segment(Joint(Joint::None), Frame(before)));
    chain.addSegment(KDL::Segment(Joint(kind)));
  };
  add(Joint::RotZ, {0, 0, 0.30});
  add(Joint::RotY, {0.07, 0, 0.10});
  add(Joint::RotY, {0, 0, 0.47});
  add(Joint::RotX, {0.25, 0, 0.05});
  add(Joint::RotY, {0.22, 0, 0});
  add(Joint::RotX, {0.09, 0, 0});
  chain.addSegment(KDL::Segment(Joint(Joint::None), Frame(KDL::Rotation::RPY(0, kPi / 2, 0), Vector(0.14, 0, 0))));
  return chain;
}

KDL::JntArray kdl_joints(const Joints& q) {
  KDL::JntArray result(6);
  result.data = q.head<6>();
  return result;
}

TEST(Arm, Forward_kinematics_agrees_with_KDL) {
  const Arm sut = cell_arm();
  const KDL::Chain chain = kdl_arm();
  KDL::ChainFkSolverPos_recursive solver(chain);
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Joints q = anywhere(sut, random);
    KDL::Frame frame;
    ASSERT_GE(solver.JntToCart(kdl_joints(q), frame), 0);
    Pose expected;
    expected.position = Vec3(frame.p.x(), frame.p.y(), frame.p.z());
    frame.M.GetQuaternion(expected.orientation.x(), expected.orientation.y(), expected.orientation.z(),
                          expected.orientation.w());
    EXPECT_LT(distance(sut.forward(q), expected), 1e-9);
  }
}

TEST(Arm, Jacobian_agrees_with_KDL) {
  const Arm sut = cell_arm();
  const KDL::Chain chain = kdl_arm();
  KDL::ChainJntToJacSolver solver(chain);
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    const Joints q = anywhere(sut, random);
    KDL::Jacobian expected(6);
    ASSERT_GE(solver.JntToJac(kdl_joints(q), expected), 0);
    EXPECT_LT((sut.jacobian(q).leftCols<6>() - expected.data).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Arm, Jacobian_is_the_derivative_of_forward_kinematics) {
  const Arm sut = odd_arm();
  std::mt19937 random(3);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 300; ++i) {
    const Joints q = anywhere(sut, random);
    const Jacobian j = sut.jacobian(q);
    for (int k = 0; k < kAxes; ++k) {
      Joints there = q;
      Joints back = q;
      there[k] += kStep;
      back[k] -= kStep;
      const Twist expected = difference(sut.forward(back), sut.forward(there)) / (2 * kStep);
      EXPECT_LT((j.col(k) - expected).norm(), 1e-6);
    }
  }
}

TEST(Arm, Names_the_first_axis_beyond_its_limits) {
  const Arm sut = cell_arm();
  Joints q = Joints::Zero();
  EXPECT_EQ(sut.beyond_limits(q), -1);
  q[4] = 3;
  EXPECT_EQ(sut.beyond_limits(q), 4);
  q[1] = std::nan("");
  EXPECT_EQ(sut.beyond_limits(q), 1);
}

TEST(Geometry, Roll_pitch_yaw_round_trip) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  for (int i = 0; i < 1000; ++i) {
    const Quat q = from_rpy({angle(random), angle(random) / 2, angle(random)});
    EXPECT_LT(rotation_between(q, from_rpy(to_rpy(q))).norm(), 1e-7);
  }
  const Quat down = from_rpy({0, kPi / 2, 0.3});
  EXPECT_LT(rotation_between(down, from_rpy(to_rpy(down))).norm(), 1e-6);
}

TEST(Urdf, Limits_and_names_are_those_of_the_file) {
  const auto model = arm_from_urdf("robot.urdf", cell_urdf());
  ASSERT_TRUE(model.ok());
  EXPECT_EQ(model->arm.axis(3).name, "joint4");
  EXPECT_DOUBLE_EQ(model->arm.axis(1).upper, 2.356);
  EXPECT_DOUBLE_EQ(model->velocity[5], 8.72);
}

std::vector<std::string> errors_with(const std::string& from, const std::string& to) {
  std::string text = cell_urdf();
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, from.size(), to);
  std::vector<std::string> errors;
  if (const auto model = arm_from_urdf("robot.urdf", text); !model.ok()) {
    for (const base::Diagnostic& each : model.error()) {
      errors.push_back(base::to_string(each));
    }
  }
  return errors;
}

TEST(Urdf, Errors_name_place_joint_and_cure) {
  EXPECT_EQ(errors_with("<limit lower=\"-2.094\" upper=\"2.094\" velocity=\"6.98\"",
                        "<limit lower=\"-2.094\" upper=\"2.094\" velocity=\"0\"")
                .at(0),
            "robot.urdf:42:3: error: joint 'joint5' has no <limit> with a velocity above 0 (rad/s)");
  EXPECT_EQ(
      errors_with("name=\"joint3\" type=\"revolute\"", "name=\"joint3\" type=\"floating\"").at(0),
      "robot.urdf:28:3: error: joint 'joint3' has to be revolute, continuous, prismatic or fixed between root and "
      "tool");
  EXPECT_EQ(errors_with("<limit lower=\"-2.094\" upper=\"2.094\" velocity=\"6.98\"",
                        "<mimic joint=\"joint9\"/>\n    <limit lower=\"-2.094\" upper=\"2.094\" velocity=\"6.98\"")
                .at(0),
            "robot.urdf:42:3: error: joint 'joint5' follows 'joint9', which is no axis between root and tool");
  EXPECT_EQ(arm_from_urdf("robot.urdf", "<robot name='none'><link name='base'/></robot>").error().at(0).text,
            "the arm has 0 axes between root and tool; 1 to 8 are possible");
}

}  // namespace
}  // namespace indurop::robot
