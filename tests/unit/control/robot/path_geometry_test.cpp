// SPDX-License-Identifier: Apache-2.0
#include "control/robot/plan/path_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class PathGeometry : public testing::Test {
 protected:
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  Vec3 somewhere() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }

  // A draft that begins where the arm is with these joint angles.
  Draft draft_from(const Joints& from) const {
    Draft draft;
    draft.segment.from = from;
    draft.segment.start = arm.forward(from);
    draft.joints = limits;
    draft.tool = tool;
    draft.work.begin(inverse.closed_form());
    return draft;
  }
  static MoveCommand to_pose(Move move, const Pose& end, const Pose& mid = {}) {
    MoveCommand command;
    command.move = move;
    command.target.is_pose = command.mid.is_pose = true;
    command.target.pose = end;
    command.mid.pose = mid;
    return command;
  }

  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits = cell_limits();
  ToolLimits tool{1, 4, 40, kPi, 4 * kPi, 40 * kPi};
  std::mt19937 random{11};
};

// Three points of a circle whose centre, radius and plane were chosen: the path is the part of that circle from the
// first through the second to the third.
TEST_F(PathGeometry, A_circle_leads_through_its_three_points) {
  int made = 0;
  for (int i = 0; i < 300; ++i) {
    const Joints from = anywhere(arm, random, 0.2);
    Draft draft = draft_from(from);
    const Vec3 start = draft.segment.start.position;
    const double radius = in(0.02, 0.2);
    const Vec3 x = somewhere().normalized();
    const Vec3 y = x.cross(somewhere()).normalized();
    const Vec3 center = start - radius * x;
    const double angle = in(0.3, 6);
    const double middle = in(0.1, 0.9) * angle;
    const auto on_circle = [&](double turned) {
      return Vec3(center + radius * (std::cos(turned) * x + std::sin(turned) * y));
    };
    const Quat held = draft.segment.start.orientation;
    const Fault fault =
        make_path(places, to_pose(Move::Circle, {on_circle(angle), held}, {on_circle(middle), held}), draft);
    if (fault.code == ErrorCode::Unreachable || fault.code == ErrorCode::JointLimit) {
      continue;  // its end is beyond the arm
    }
    ASSERT_TRUE(fault.ok()) << to_string(fault.code);
    ++made;
    const Segment& s = draft.segment;
    EXPECT_NEAR(s.angle, angle, 1e-6);
    EXPECT_NEAR(s.way, angle * radius, 1e-6);
    EXPECT_LT((s.center - center).norm(), 1e-6);
    for (const double part : {0.0, middle / angle, 0.77, 1.0}) {
      EXPECT_LT((s.pose_at(part * s.length).position - on_circle(part * angle)).norm(), 1e-6);
    }
    // Half of the acceleration of the tool holds it on the circle at full speed.
    const double speed = s.limits.velocity * s.pace();
    EXPECT_LE(speed, tool.velocity * (1 + 1e-9));
    EXPECT_LE(speed * speed / radius, tool.acceleration / 2 * (1 + 1e-9));
  }
  EXPECT_GT(made, 50);
}

TEST_F(PathGeometry, Three_points_on_a_line_are_no_circle) {
  Draft draft = draft_from(joints_of({0, 0.2, 0.1, 0, 0.8, 0}));
  const Pose start = draft.segment.start;
  const Pose mid{start.position + Vec3(0.02, 0.01, 0), start.orientation};
  const Pose end{start.position + Vec3(0.06, 0.03, 0), start.orientation};
  EXPECT_EQ(make_path(places, to_pose(Move::Circle, end, mid), draft).code, ErrorCode::Circle);
}

TEST_F(PathGeometry, A_line_takes_as_long_as_its_way_or_its_turn) {
  Draft draft = draft_from(joints_of({0, 0.2, 0.1, 0, 0.8, 0}));
  const Pose start = draft.segment.start;
  const Pose moved{start.position + Vec3(0.03, 0, 0.04), start.orientation};
  ASSERT_TRUE(make_path(places, to_pose(Move::Line, moved), draft).ok());
  EXPECT_NEAR(draft.segment.way, 0.05, 1e-12);
  EXPECT_NEAR(draft.segment.length, 0.05 / tool.velocity, 1e-9);
  draft = draft_from(draft.segment.from);
  const Pose turned{start.position, start.orientation * from_rpy({0, 0, 0.3})};
  ASSERT_TRUE(make_path(places, to_pose(Move::Line, turned), draft).ok());
  EXPECT_NEAR(draft.segment.length, 0.3 / tool.turn_velocity, 1e-9);
  draft = draft_from(draft.segment.from);
  ASSERT_TRUE(make_path(places, to_pose(Move::Line, start), draft).ok());
  EXPECT_EQ(draft.segment.length, 0);
  EXPECT_EQ(draft.segment.to, draft.segment.from);
}

TEST_F(PathGeometry, A_joint_motion_takes_as_long_as_its_slowest_axis) {
  Draft draft = draft_from(joints_of({0, 0.2, 0.1, 0, 0.8, 0}));
  MoveCommand command;
  command.target.joints = joints_of({0.4, 0.2, -0.3, 0, 0.8, 1});
  ASSERT_TRUE(make_path(places, command, draft).ok());
  const Joints change = command.target.joints - draft.segment.from;
  double slowest = 0;
  for (int i = 0; i < kAxes; ++i) {
    slowest = std::max(slowest, std::abs(change[i]) / limits.velocity[i]);
  }
  EXPECT_NEAR(draft.segment.length, slowest, 1e-12);
  EXPECT_TRUE(draft.segment.together);
}

TEST_F(PathGeometry, What_is_no_number_or_out_of_range_is_refused) {
  const Joints from = joints_of({0, 0.2, 0.1, 0, 0.8, 0});
  const auto code = [&](auto change) {
    Draft draft = draft_from(from);
    MoveCommand command;
    command.target.joints = from;
    change(command);
    return make_path(places, command, draft).code;
  };
  EXPECT_EQ(code([](MoveCommand&) {}), ErrorCode::Ok);
  EXPECT_EQ(code([](MoveCommand& c) { c.speed = 0; }), ErrorCode::Value);
  EXPECT_EQ(code([](MoveCommand& c) { c.speed = 1.01; }), ErrorCode::Value);
  EXPECT_EQ(code([](MoveCommand& c) { c.acceleration = std::nan(""); }), ErrorCode::Value);
  EXPECT_EQ(code([](MoveCommand& c) { c.zone = -0.001; }), ErrorCode::Value);
  EXPECT_EQ(code([](MoveCommand& c) { c.tool_speed = -1; }), ErrorCode::Value);
  EXPECT_EQ(code([](MoveCommand& c) { c.target.joints[2] = std::nan(""); }), ErrorCode::Value);
  EXPECT_EQ(code([](MoveCommand& c) { c.target.joints[2] = 100; }), ErrorCode::JointLimit);
}

}  // namespace
}  // namespace indurop::robot
