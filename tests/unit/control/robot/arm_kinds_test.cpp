// SPDX-License-Identifier: Apache-2.0
// Arms that are not made of six turning axes, from tests/unit/control/robot/arms. The second opinion on where the tool
// is comes from orocos-kdl, for which each arm is described again.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <vector>

#include "control/robot/kinematics/abilities.h"
#include "control/robot/kinematics/inverse.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

using KDL::Frame;
using KDL::Joint;
using KDL::Rotation;
using KDL::Vector;

struct Part {
  Frame before;
  Joint::JointType kind = Joint::Fixed;
  int axis = 0;  // from 0
  double ratio = 1;
};

struct Known {
  const char* file;
  std::vector<Part> parts;
  Frame tool;
  std::vector<Part> to_workpiece{};  // from the root, as the arm's
  Frame workpiece{};
};

Frame at(double x, double y, double z) {
  return Frame(Vector(x, y, z));
}

const Frame kTurnedOver(Rotation::RotX(kPi));

// Long: a table of arms.
std::vector<Known> known_arms() {
  return {
      {"scara",
       {{at(0, 0, 0.387), Joint::RotZ, 0},
        {at(0.325, 0, 0), Joint::RotZ, 1},
        {at(0.275, 0, 0) * kTurnedOver, Joint::TransZ, 2},
        {at(0, 0, 0), Joint::RotZ, 3}},
       at(0, 0, 0.05)},
      {"gantry",
       {{at(0, 0, 2), Joint::TransX, 0},
        {at(0, 0, 0), Joint::TransY, 1},
        {at(0, 0, 0), Joint::TransZ, 2},
        {at(0, 0, -0.3) * kTurnedOver, Joint::RotZ, 3}},
       at(0, 0, 0.1)},
      {"palletiser",
       {{at(0, 0, 0.35), Joint::RotZ, 0},
        {at(0.35, 0, 0.4), Joint::RotY, 1},
        {at(0, 0, 1.25), Joint::RotY, 2},
        {at(1.45, 0, 0), Joint::RotY, 1, -1},
        {at(0, 0, 0), Joint::RotY, 2, -1},
        {at(0.25, 0, 0) * kTurnedOver, Joint::RotZ, 3}},
       at(0, 0, 0.2)},
      {"five_axis",
       {{at(0, 0, 0.35), Joint::RotZ, 0},
        {at(0.03, 0, 0.05), Joint::RotY, 1},
        {at(0, 0, 0.25), Joint::RotY, 2},
        {at(0.21, 0, 0), Joint::RotY, 3},
        {at(0.07, 0, 0) * Frame(Rotation::RotY(kPi / 2)), Joint::RotZ, 4}},
       at(0, 0, 0.1)},
      {"iiwa14",
       {{at(0, 0, 0), Joint::RotZ, 0},
        {Frame::DH(0, -kPi / 2, 0.36, 0), Joint::RotZ, 1},
        {Frame::DH(0, kPi / 2, 0, 0), Joint::RotZ, 2},
        {Frame::DH(0, kPi / 2, 0.42, 0), Joint::RotZ, 3},
        {Frame::DH(0, -kPi / 2, 0, 0), Joint::RotZ, 4},
        {Frame::DH(0, -kPi / 2, 0.4, 0), Joint::RotZ, 5},
        {Frame::DH(0, kPi / 2, 0, 0), Joint::RotZ, 6}},
       at(0, 0, 0.126)},
      {"rail",
       {{at(0, 0, 0), Joint::TransX, 0},
        {at(0, 0, 0.2), Joint::RotZ, 1},
        {Frame::DH(0, kPi / 2, 0.1273, 0), Joint::RotZ, 2},
        {Frame::DH(-0.612, 0, 0, 0), Joint::RotZ, 3},
        {Frame::DH(-0.5723, 0, 0, 0), Joint::RotZ, 4},
        {Frame::DH(0, kPi / 2, 0.163941, 0), Joint::RotZ, 5},
        {Frame::DH(0, -kPi / 2, 0.1157, 0), Joint::RotZ, 6}},
       at(0, 0, 0.0922)},
      {"turntable",
       {{at(-0.9, 0.1, 0.2) * Frame(Rotation::RotZ(0.3)), Joint::RotZ, 0},
        {Frame::DH(0, kPi / 2, 0.1273, 0), Joint::RotZ, 1},
        {Frame::DH(-0.612, 0, 0, 0), Joint::RotZ, 2},
        {Frame::DH(-0.5723, 0, 0, 0), Joint::RotZ, 3},
        {Frame::DH(0, kPi / 2, 0.163941, 0), Joint::RotZ, 4},
        {Frame::DH(0, -kPi / 2, 0.1157, 0), Joint::RotZ, 5}},
       at(0, 0, 0.0922),
       {{at(0, 0.05, 0.45), Joint::RotZ, 6}},
       at(0, 0, 0.02) * Frame(Rotation::RotZ(0.5))},
      {"tilt_table",
       {{at(0, 0, 0.4), Joint::RotZ, 0},
        {at(0.1, 0, 0.05), Joint::RotY, 1},
        {at(0, 0, 0.6), Joint::RotY, 2},
        {at(0.2, 0, 0.1), Joint::RotX, 3},
        {at(0.4, 0, 0), Joint::RotY, 4},
        {at(0.1, 0, 0), Joint::RotX, 5}},
       Frame(Rotation::RotY(kPi / 2)),
       {{at(0.9, 0, 0.5), Joint::RotY, 6}, {at(0, 0, 0.1), Joint::RotZ, 7}},
       at(0, 0, 0)},
  };
}

Frame end_of(const std::vector<Part>& parts, const Frame& end, const Joints& q) {
  KDL::Chain chain;
  KDL::JntArray joints(static_cast<unsigned>(parts.size()));
  for (unsigned i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    chain.addSegment(KDL::Segment(Joint(Joint::Fixed), part.before));
    chain.addSegment(KDL::Segment(Joint(part.kind)));
    joints(i) = part.ratio * q[part.axis];
  }
  chain.addSegment(KDL::Segment(Joint(Joint::Fixed), end));
  Frame frame;
  EXPECT_GE(KDL::ChainFkSolverPos_recursive(chain).JntToCart(joints, frame), 0);
  return frame;
}

// Seen from the workpiece, if axes move it.
Pose by_kdl(const Known& known, const Joints& q) {
  const Frame frame = end_of(known.to_workpiece, known.workpiece, q).Inverse() * end_of(known.parts, known.tool, q);
  Pose pose;
  pose.position = Vec3(frame.p.x(), frame.p.y(), frame.p.z());
  Quat& turn = pose.orientation;
  frame.M.GetQuaternion(turn.x(), turn.y(), turn.z(), turn.w());
  return pose;
}

TEST(ArmKinds, Forward_kinematics_agrees_with_KDL) {
  for (const Known& known : known_arms()) {
    const Arm sut = arm_of(known.file);
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
      const Joints q = anywhere(sut, random);
      ASSERT_LT(distance(sut.forward(q), by_kdl(known, q)), 1e-9) << known.file << " " << q.transpose();
    }
  }
}

// The world's frame is where the workpiece is with its axes at zero.
TEST(ArmKinds, In_the_world_the_tool_is_where_KDL_says) {
  for (const Known& known : known_arms()) {
    const Arm sut = arm_of(known.file);
    std::mt19937 random(5);
    for (int i = 0; i < 100; ++i) {
      const Joints q = anywhere(sut, random);
      const Frame frame =
          end_of(known.to_workpiece, known.workpiece, Joints::Zero()).Inverse() * end_of(known.parts, known.tool, q);
      const ChainFrame world = sut.world(q);
      const Vec3 there = world.turn.transpose() * (sut.forward(q).position - world.shift);
      ASSERT_LT((there - Vec3(frame.p.x(), frame.p.y(), frame.p.z())).norm(), 1e-9) << known.file;
      ASSERT_LT((sut.in_world().forward(q).position - there).norm(), 1e-9) << known.file;
    }
  }
}

TEST(ArmKinds, Jacobian_is_the_derivative_of_forward_kinematics) {
  constexpr double kStep = 1e-6;
  for (const Known& known : known_arms()) {
    const Arm sut = arm_of(known.file);
    std::mt19937 random(2);
    for (int i = 0; i < 20; ++i) {
      const Joints q = anywhere(sut, random);
      const Jacobian j = sut.jacobian(q);
      for (int k = 0; k < kAxes; ++k) {
        Joints there = q;
        Joints back = q;
        there[k] += kStep;
        back[k] -= kStep;
        const Twist expected = difference(sut.forward(back), sut.forward(there)) / (2 * kStep);
        ASSERT_LT((j.col(k) - expected).norm(), 1e-6) << known.file;
      }
    }
  }
}

// How far from the pose any of these are; nothing found is far.
double farthest(const Arm& arm, const Pose& pose, const Solutions& found) {
  double worst = found.count > 0 ? 0 : HUGE_VAL;
  for (int k = 0; k < found.count; ++k) {
    const Joints& q = found.list[static_cast<std::size_t>(k)].q;
    worst = std::max(worst, distance(arm.forward(q), pose));
    EXPECT_EQ(arm.beyond_limits(q), -1);
  }
  return worst;
}

TEST(ArmKinds, Poses_made_of_joints_are_found_again) {
  constexpr double kGood = 2e-9;
  for (const Known& known : known_arms()) {
    const Arm arm = arm_of(known.file);
    const Inverse sut(arm);
    const int count = poses(200);
    std::mt19937 random(3);
    int reached = 0;
    double worst = 0;
    for (int i = 0; i < count; ++i) {
      const Pose pose = by_kdl(known, anywhere(arm, random));
      const Joints near = anywhere(arm, random);
      double off = farthest(arm, pose, sut.search(pose, near, {.least = 1}));
      off = off < kGood ? off : farthest(arm, pose, sut.search(pose, near));
      reached += off < kGood ? 1 : 0;
      worst = std::max(worst, off < kGood ? off : 0);
    }
    fmt::print("{}: {} of {} found, {:.1e} off at most\n", known.file, reached, count, worst);
    EXPECT_GE(reached, count * 999 / 1000) << known.file;
  }
}

// Where the axes that follow the tool could not lead it, the arm is singular, whatever a table, a rail or an elbow
// could do: they stand where a command says. The rates of the others come from differences of poses.
TEST(ArmKinds, Redundant_axes_do_not_help_in_singular_positions) {
  for (const char* const name : {"tilt_table", "turntable", "iiwa14", "rail"}) {
    const Arm arm = arm_of(name);
    std::mt19937 random(8);
    for (int i = 0; i < 50; ++i) {
      const Joints q = anywhere(arm, random);
      Eigen::Matrix<double, 6, 6> rates;
      for (int a = 0, column = 0; a < arm.count(); ++a) {
        if (holds(redundant_axes(arm), a)) {
          continue;
        }
        constexpr double kStep = 1e-6;
        Joints more = q;
        Joints less = q;
        more[a] += kStep;
        less[a] -= kStep;
        rates.col(column++) = difference(arm.forward(less), arm.forward(more)) / (2 * kStep);
      }
      EXPECT_NEAR(arm.volume(q), rates.determinant(), 1e-7) << name;
    }
  }
  const Arm table = arm_of("tilt_table");
  EXPECT_NEAR(table.volume(joints_of({0.2, 0.3, -0.4, 0.5, 0, 0.7, 0.8, 0.9})), 0, 1e-12);
}

// Small steps from a place to another one: what the real-time path does with every period.
TEST(ArmKinds, A_path_is_followed_from_place_to_place) {
  int ways = 0;
  for (const Known& known : known_arms()) {
    const Arm arm = arm_of(known.file);
    const Inverse sut(arm);
    std::mt19937 random(4);
    double usual = 0;
    for (int i = 0; i < 64; ++i) {
      usual = std::max(usual, std::abs(arm.volume(arm.spread(i))));
    }
    Joints pace = Joints::Zero();
    for (int a = 0; a < arm.count(); ++a) {
      pace[a] = holds(redundant_axes(arm), a) ? 0 : 0.002 * std::sin(a + 1);
    }
    for (int i = 0; i < 40; ++i) {
      const Joints from = anywhere(arm, random);
      const Joints end = from + 50 * pace;
      const double least = std::min(std::abs(arm.volume(from)), std::abs(arm.volume(end)));
      if (arm.beyond_limits(end) >= 0 || least < 0.2 * usual) {
        continue;
      }
      ++ways;
      Joints to = from;
      Joints q = from;
      for (int step = 1; step <= 50; ++step) {
        to += pace;
        const auto found = sut.nearest(arm.forward(to), q);
        ASSERT_EQ(found.reach, Reach::Ok) << known.file;
        q = found.solution.q;
        ASSERT_LT(distance(arm.forward(q), arm.forward(to)), 1e-6) << known.file;
      }
      EXPECT_LT((q - to).norm(), 1e-3) << known.file;
    }
  }
  EXPECT_GT(ways, 60);
}

// An arm of five axes cannot turn its tool as it likes: it keeps to the line and turns as near as it can.
TEST(ArmKinds, Fewer_axes_keep_the_position_exactly) {
  const Arm arm = arm_of("five_axis");
  const Inverse sut(arm);
  Joints q = joints_of({0.3, 0.4, 0.6, -0.2, 0.2});
  const Pose start = arm.forward(q);
  for (int step = 1; step <= 100; ++step) {
    Pose pose = start;
    pose.position += 0.001 * step * Vec3(0, 1, 0.2);
    const auto found = sut.nearest(pose, q);
    ASSERT_EQ(found.reach, Reach::Ok) << step;
    q = found.solution.q;
    ASSERT_LT((arm.forward(q).position - pose.position).norm(), 1e-9) << step;
  }
  EXPECT_GT(rotation_between(start.orientation, arm.forward(q).orientation).norm(), 0.1);
}

TEST(ArmKinds, Say_what_they_can_do) {
  const auto said = [](const char* name) {
    const Arm arm = arm_of(name);
    return abilities(arm, Inverse(arm));
  };
  EXPECT_EQ(said("scara"),
            "4 axes, inverse kinematics step by step; poses: x y z and turns about (0 0 1) of the base; no postures");
  EXPECT_EQ(said("gantry"), said("scara"));
  EXPECT_EQ(said("palletiser"), said("scara"));
  EXPECT_EQ(said("five_axis"),
            "5 axes, inverse kinematics step by step; poses: x y z and 2 turns, the rest of the orientation follows; "
            "no postures");
  EXPECT_EQ(
      said("ur5"),
      "6 axes, three of them parallel, inverse kinematics in closed form; poses: any pose in its reach; postures: "
      "shoulder, elbow, wrist");
  EXPECT_EQ(
      said("iiwa14"),
      "7 axes, inverse kinematics step by step; poses: any pose in its reach; a pose leaves axis 3 (joint3) open: "
      "AXIS 3 says where it stands; no postures");
  EXPECT_EQ(said("rail"),
            "7 axes, inverse kinematics step by step; poses: any pose in its reach; a pose leaves axis 1 (rail) open: "
            "AXIS 1 says where it stands; no postures");
  EXPECT_EQ(said("turntable"),
            "7 axes, three of them parallel, inverse kinematics in closed form; poses: any pose in its reach, in the "
            "workpiece's frame; axis 7 (turn) moves the workpiece: AXIS 7 says where it stands; postures: shoulder, "
            "elbow, wrist");
}

}  // namespace
}  // namespace indurop::robot
