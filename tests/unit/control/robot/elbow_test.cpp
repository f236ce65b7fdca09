// SPDX-License-Identifier: Apache-2.0
// The elbow of arms with seven axes: poses near the present one are found, and lines along which a held elbow would
// lead to a limit. Where the tool is comes from orocos-kdl, for which each arm is described again. INDUROP_ROBOT_POSES
// says how many poses, INDUROP_ROBOT_ELBOWS how many lines of each arm.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <kdl/chainfksolverpos_recursive.hpp>

#include "control/robot/kinematics/inverse.h"
#include "control/robot/plan/planner.h"
#include "drive_faults.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

int elbows(int usual) {
  const char* const text = std::getenv("INDUROP_ROBOT_ELBOWS");
  return text == nullptr ? usual : std::atoi(text);
}

class Elbow : public testing::TestWithParam<const char*> {
 protected:
  static bool is_panda() { return std::string(GetParam()) == "panda"; }
  static KDL::Chain chain() {
    using KDL::Frame;
    using KDL::Joint;
    KDL::Chain chain;
    const auto add = [&](const Frame& before, bool moves = true) {
      chain.addSegment(KDL::Segment(Joint(Joint::None), before));
      if (moves) {
        chain.addSegment(KDL::Segment(Joint(Joint::RotZ)));
      }
    };
    if (is_panda()) {
      for (const ArmSpec::Part& p : panda_spec().parts) {
        add(Frame(KDL::Rotation::RPY(p.turn[0], p.turn[1], p.turn[2]),
                  KDL::Vector(p.place[0], p.place[1], p.place[2])));
      }
      add(Frame(KDL::Vector(0, 0, 0.107)), false);
      return chain;
    }
    add(Frame::Identity());
    for (const auto& [twist, offset] : {std::pair{-1, 0.36}, {1, 0.}, {1, 0.42}, {-1, 0.}, {-1, 0.4}, {1, 0.}}) {
      add(Frame::DH(0, twist * kPi / 2, offset, 0));
    }
    add(Frame(KDL::Vector(0, 0, 0.126)), false);
    return chain;
  }
  Pose by_kdl(const Joints& q) {
    KDL::JntArray joints(7);
    for (unsigned i = 0; i < 7; ++i) {
      joints(i) = q[i];
    }
    KDL::Frame frame;
    EXPECT_GE(solver.JntToCart(joints, frame), 0);
    Pose pose;
    pose.position = Vec3(frame.p.x(), frame.p.y(), frame.p.z());
    frame.M.GetQuaternion(pose.orientation.x(), pose.orientation.y(), pose.orientation.z(), pose.orientation.w());
    return pose;
  }
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Joints near_to(const Joints& q, double far, double margin) {
    Joints to = q;
    for (int i = 0; i < arm.count(); ++i) {
      to[i] = std::clamp(q[i] + in(-far, far), arm.axis(i).lower + margin, arm.axis(i).upper - margin);
    }
    return to;
  }
  // A line that takes more work than this is near a singular position: it is not about the elbow.
  Fault plan(const MoveCommand& command, const Joints& from) {
    constexpr int kMostWork = 35000;
    Fault fault = planner->begin(command, from);
    while (fault.ok() && !planner->done() && planner->work() < kMostWork) {
      fault = planner->check(64);
    }
    return planner->done() || !fault.ok() ? fault : Fault{ErrorCode::Singular};
  }
  static MoveCommand line_to(const Pose& pose) {
    MoveCommand command;
    command.move = Move::Line;
    command.target.is_pose = true;
    command.target.pose = pose;
    return command;
  }
  double milliseconds_of(const MoveCommand& command, const Joints& from) {
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_TRUE(plan(command, from).ok());
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }
  // The same line with the elbow held.
  static MoveCommand holding(MoveCommand command, const Joints& from) {
    command.target.held = 1U << 2U;
    command.target.joints = from;
    return command;
  }
  // The joints at equal parts of the planned line, in meters and radians the farthest that they are off it.
  std::vector<Joints> walk(const Segment& s, int parts, double* off) {
    std::vector<Joints> all{s.from};
    for (int i = 1; i <= parts; ++i) {
      Joints q = all.back();
      const double part = static_cast<double>(i) / parts;
      EXPECT_EQ(places.on_path(s, (s.timed ? s.stretch : s.length) * part, all.back(), q), Reach::Ok);
      const Pose wanted{s.start.position + part * (s.end.position - s.start.position),
                        s.start.orientation.slerp(part, s.end.orientation)};
      *off = std::max(*off, distance(by_kdl(q), wanted));
      all.push_back(q);
    }
    return all;
  }

  std::mt19937 random{7};
  Arm arm = is_panda() ? arm_from_urdf("arm.urdf", panda_spec().urdf())->arm : arm_of(GetParam());
  KDL::Chain kdl = chain();
  KDL::ChainFkSolverPos_recursive solver{kdl};
  Inverse sut{arm};
  Places places{arm, sut};
  std::unique_ptr<Planner> planner =
      std::make_unique<Planner>(places, JointLimits{Joints::Constant(2), Joints::Constant(8), Joints::Constant(80)},
                                ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi});
};

TEST_P(Elbow, Moves_to_reach_a_pose_near_the_present_one) {
  for (const double far : {0.05, 0.2, 0.5}) {
    const int count = poses(200);
    int held = 0;
    int reached = 0;
    int with_room = 0;
    double off = 0;
    for (int i = 0; i < count; ++i) {
      const Joints near = anywhere(arm, random);
      const Joints to = near_to(near, far, 0);
      const Pose pose = by_kdl(to);
      held += sut.nearest(pose, near).reach == Reach::Ok ? 1 : 0;
      const auto found = sut.reach(pose, near);
      if (found.reach == Reach::Ok) {
        ++reached;
        off = std::max(off, distance(by_kdl(found.solution.q), pose));
        EXPECT_EQ(arm.beyond_limits(found.solution.q), -1);
        with_room += room_of(arm, found.solution.q) >= kElbowRoom ? 1 : 0;
      }
    }
    fmt::print("{} within {}: {} with the elbow held, {} with its movement ({} with room) of {}, {:.1e} off\n",
               GetParam(), far, held, reached, with_room, count, off);
    EXPECT_LT(off, 1e-6);
    EXPECT_GE(reached, held);
    EXPECT_GE(reached, count * (far < 0.3 ? 0.98 : 0.9));
  }
}

TEST_P(Elbow, Moves_on_lines_that_it_would_not_reach_held) {
  const int count = elbows(12);
  int held = 0;
  int chosen = 0;
  int moved = 0;
  int lost = 0;
  double off = 0;
  for (int i = 0; i < count; ++i) {
    SCOPED_TRACE(i);
    const Joints from = anywhere(arm, random, 0.02);
    const MoveCommand command = line_to(by_kdl(near_to(from, 0.4, 0.02)));
    const bool if_held = plan(holding(command, from), from).ok();
    held += if_held ? 1 : 0;
    if (!plan(command, from).ok()) {
      lost += if_held ? 1 : 0;
      continue;
    }
    ++chosen;
    const Segment s = planner->segment();
    moved += s.elbow_moves ? 1 : 0;
    const std::vector<Joints> way = walk(s, 50, &off);
    for (std::size_t k = 1; k < way.size(); ++k) {
      ASSERT_EQ(arm.beyond_limits(way[k]), -1);
      ASSERT_NEAR(way[k][2], from[2] + static_cast<double>(k) / 50 * (s.to[2] - from[2]), 1e-9);
      ASSERT_LT((way[k] - way[k - 1]).cwiseAbs().maxCoeff(), 0.5);
    }
  }
  fmt::print("{}: {} lines with the elbow held, {} with its choice ({} moved it, {} lost) of {}, {:.1e} off\n",
             GetParam(), held, chosen, moved, lost, count, off);
  EXPECT_LT(off, 1e-6);
  EXPECT_EQ(lost, 0);
  EXPECT_GT(chosen, held);
  EXPECT_GT(moved, 0);
}

// What is planned depends on the line only, and a line that is repeated settles.
TEST_P(Elbow, Takes_the_same_path_at_any_speed) {
  int moved = 0;
  for (int i = 0; i < 100 && moved < 2; ++i) {
    SCOPED_TRACE(i);
    const Joints from = anywhere(arm, random, 0.02);
    MoveCommand command = line_to(by_kdl(near_to(from, 0.4, 0.02)));
    if (!plan(command, from).ok() || !planner->segment().elbow_moves) {
      continue;
    }
    ++moved;
    double off = 0;
    const std::vector<Joints> fast = walk(planner->segment(), 30, &off);
    command.speed = 0.5;
    ASSERT_TRUE(plan(command, from).ok());
    EXPECT_EQ(walk(planner->segment(), 30, &off), fast);
  }
  EXPECT_GE(moved, 2);
}

// How long the choice takes: compared with the same line whose command says where the elbow goes.
TEST_P(Elbow, Is_chosen_in_a_part_of_the_time_of_planning) {
  const int count = elbows(12);
  double chosen = 0;
  double given = 0;
  double most = 0;
  for (int i = 0; i < count; ++i) {
    const Joints from = anywhere(arm, random, 0.02);
    const MoveCommand command = line_to(by_kdl(near_to(from, 0.4, 0.02)));
    if (!plan(command, from).ok()) {
      continue;
    }
    const int work = planner->work();
    MoveCommand same = holding(command, from);
    same.target.joints[2] = planner->segment().to[2];
    const double one = milliseconds_of(command, from);
    const double other = milliseconds_of(same, from);
    EXPECT_LE(planner->work(), work);
    chosen += one;
    given += other;
    most = std::max(most, one - other);
  }
  fmt::print("{}: planned in {:.0f} ms, {:.0f} ms of it without the choice, which takes {:.1f} ms at most\n",
             GetParam(), chosen, given, most);
  EXPECT_GT(given, 0);
}

TEST_P(Elbow, Goes_where_the_command_says) {
  int planned = 0;
  for (int i = 0; i < 30 && planned < 8; ++i) {
    SCOPED_TRACE(i);
    const Joints from = anywhere(arm, random, 0.5);
    const Joints to = near_to(from, 0.3, 0.4);
    MoveCommand command = holding(line_to(by_kdl(to)), to);
    command.target.pose = i % 2 == 0 ? command.target.pose : by_kdl(from);  // only the elbow moves
    if (!plan(command, from).ok()) {
      continue;
    }
    ++planned;
    double off = 0;
    const std::vector<Joints> way = walk(planner->segment(), 50, &off);
    EXPECT_NEAR(way.back()[2], to[2], 1e-9);
    EXPECT_LT(off, 1e-6);
  }
  EXPECT_GE(planned, 5);
  const Joints from = joints_of({0, 0.4, 0, -1, 0, 1.3, 0.7});
  MoveCommand beyond = holding(line_to(by_kdl(from)), from);
  beyond.target.joints[2] = 3.2;
  const Fault fault = plan(beyond, from);
  EXPECT_EQ(fault.code, ErrorCode::JointLimit);
  EXPECT_EQ(fault.axis, 3);
}

INSTANTIATE_TEST_SUITE_P(Of_seven_axes, Elbow, testing::Values("panda", "iiwa14"));

}  // namespace
}  // namespace indurop::robot
