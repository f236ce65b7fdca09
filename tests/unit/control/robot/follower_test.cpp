// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

// Steps a robot and watches every joint for its limits of position, velocity, acceleration and jerk.
class Watched {
 public:
  explicit Watched(double period = 0.001) : period_(period) {
    q_ = joints_of({0, 0.2, 0.1, 0, 0.8, 0});
    sut.reset(q_);
  }

  Fault add(const MoveCommand& command) {
    Fault fault = planner.begin(command, sut.idle() ? sut.joints() : sut.end());
    while (fault.ok() && !planner.done()) {
      fault = planner.check(1000);
    }
    if (fault.ok()) {
      sut.add(planner.segment(), sut.idle() ? Blend{} : planner.blend(before_, planner.segment()));
      before_ = planner.segment();
    }
    return fault;
  }

  void step() {
    const Fault fault = sut.step(period_);
    ASSERT_TRUE(fault.ok()) << to_string(fault.code) << " axis " << fault.axis;
    const Joints v = (sut.joints() - q_) / period_;
    const Joints a = (v - v_) / period_;
    const Joints j = (a - a_) / period_;
    for (int i = 0; i < kAxes; ++i) {
      velocity = std::max(velocity, std::abs(v[i]) / limits.velocity[i]);
      acceleration = std::max(acceleration, std::abs(a[i]) / limits.acceleration[i]);
      jerk = std::max(jerk, std::abs(j[i]) / limits.jerk[i]);
    }
    q_ = sut.joints();
    v_ = v;
    a_ = a;
    time += period_;
  }
  void run() {
    for (int i = 0; i < 100000 && !sut.idle(); ++i) {
      step();
    }
    for (int i = 0; i < 3; ++i) {
      step();
    }
    ASSERT_TRUE(sut.idle());
  }
  void expect_kept() const {
    EXPECT_LT(velocity, 1.001);
    EXPECT_LT(acceleration, 1.01);
    EXPECT_LT(jerk, 1.05);
  }

  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits = cell_limits();
  Planner planner{places, limits, ToolLimits{1, 4, 40, kPi, 4 * kPi, 40 * kPi}};
  Follower sut{places, limits};
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
  double time = 0;

 private:
  Segment before_;
  double period_;
  Joints q_;
  Joints v_ = Joints::Zero();
  Joints a_ = Joints::Zero();
};

MoveCommand joints(std::initializer_list<double> degrees_of, double zone = 0) {
  MoveCommand command;
  int i = 0;
  for (const double angle : degrees_of) {
    command.target.joints[i++] = radians(angle);
  }
  command.zone = zone;
  return command;
}

MoveCommand pose(Move move, const Vec3& position, double zone = 0) {
  MoveCommand command;
  command.move = move;
  command.target.is_pose = true;
  command.target.pose = {position, from_rpy({kPi, 0, kPi})};
  command.zone = zone;
  return command;
}

TEST(Follower, Joints_arrive_together_and_exactly) {
  Watched w;
  ASSERT_TRUE(w.add(joints({40, 30, -20, 10, 50, -30})).ok());
  w.run();
  EXPECT_LT((w.sut.joints() - joints({40, 30, -20, 10, 50, -30}).target.joints).norm(), 1e-12);
  w.expect_kept();
  EXPECT_GT(w.acceleration, 0.98);  // the slowest axis uses what it has
  EXPECT_GT(w.jerk, 0.98);
}

TEST(Follower, A_line_is_straight) {
  Watched w;
  ASSERT_TRUE(w.add(pose(Move::Joint, {0.5, -0.2, 0.4})).ok());
  w.run();
  ASSERT_TRUE(w.add(pose(Move::Line, {0.6, 0.3, 0.3})).ok());
  const Vec3 from(0.5, -0.2, 0.4);
  const Vec3 direction = (Vec3(0.6, 0.3, 0.3) - from).normalized();
  while (!w.sut.idle()) {
    w.step();
    const Vec3 now = w.arm.forward(w.sut.joints()).position - from;
    EXPECT_LT((now - direction * direction.dot(now)).norm(), 1e-6);
  }
  EXPECT_LT((w.arm.forward(w.sut.joints()).position - Vec3(0.6, 0.3, 0.3)).norm(), 1e-6);
  w.expect_kept();
}

TEST(Follower, A_circle_is_round) {
  Watched w;
  const Vec3 center(0.55, 0, 0.35);
  ASSERT_TRUE(w.add(pose(Move::Joint, center + Vec3(0, -0.1, 0))).ok());
  w.run();
  MoveCommand command = pose(Move::Circle, center + Vec3(0, 0.1, 0));
  command.mid = pose(Move::Circle, center + Vec3(0.1, 0, 0)).target;
  ASSERT_TRUE(w.add(command).ok());
  double farthest = 0;
  while (!w.sut.idle()) {
    w.step();
    const Vec3 now = w.arm.forward(w.sut.joints()).position - center;
    EXPECT_NEAR(now.norm(), 0.1, 1e-6);
    farthest = std::max(farthest, now.x());
  }
  EXPECT_NEAR(farthest, 0.1, 1e-4);  // through the middle, not the other way round
  w.expect_kept();
}

TEST(Follower, Blended_paths_are_faster_keep_the_limits_and_round_the_corner) {
  Watched exact;
  Watched blended;
  const auto path = [](Watched& w, double zone) {
    w.add(joints({-120, 20, 10, 0, 50, 0}, 0));
    w.add(joints({0, 60, -60, 40, 60, 20}, zone));
    w.add(joints({120, 20, 10, 0, 50, 0}, 0));
    w.run();
  };
  path(exact, 0);
  path(blended, 0.3);
  EXPECT_LT(blended.time, exact.time);
  blended.expect_kept();
  EXPECT_LT((blended.sut.joints() - joints({120, 20, 10, 0, 50, 0}).target.joints).norm(), 1e-12);
}

TEST(Follower, Blended_lines_round_the_corner_without_stopping) {
  Watched w;
  w.add(pose(Move::Joint, {0.5, -0.2, 0.3}));
  w.run();
  ASSERT_TRUE(w.add(pose(Move::Line, {0.5, -0.2, 0.5}, 0.05)).ok());
  ASSERT_TRUE(w.add(pose(Move::Line, {0.5, 0.2, 0.5}, 0.05)).ok());
  ASSERT_TRUE(w.add(pose(Move::Line, {0.5, 0.2, 0.3})).ok());
  double slowest = 1;
  double corner = 1;
  for (int i = 0; !w.sut.idle(); ++i) {
    w.step();
    const Vec3 now = w.arm.forward(w.sut.joints()).position;
    corner = std::min(corner, (now - Vec3(0.5, -0.2, 0.5)).norm());
    if (i > 100 && w.sut.source() == 0 && (now - Vec3(0.5, 0.2, 0.3)).norm() > 0.15) {
      slowest = std::min(slowest, w.sut.idle() ? 1 : w.sut.speed());
    }
  }
  EXPECT_GT(slowest, 0.05);
  EXPECT_GT(corner, 0.001);
  EXPECT_LT(corner, 0.05);
  w.expect_kept();
}

TEST(Follower, A_slight_corner_with_a_zone_is_passed_at_full_speed) {
  Watched w;
  w.add(pose(Move::Joint, {0.5, -0.25, 0.4}));
  w.run();
  const double turn = radians(15);
  MoveCommand first = pose(Move::Line, {0.5, 0, 0.4}, 0.03);
  MoveCommand second = pose(Move::Line, Vec3(0.5, 0, 0.4) + 0.25 * Vec3(std::sin(turn), std::cos(turn), 0));
  first.tool_speed = second.tool_speed = 0.5;
  ASSERT_TRUE(w.add(first).ok());
  ASSERT_TRUE(w.add(second).ok());
  double slowest = 1;
  double nearest = 1;
  Vec3 before = w.arm.forward(w.sut.joints()).position;
  while (!w.sut.idle()) {
    w.step();
    const Vec3 now = w.arm.forward(w.sut.joints()).position;
    if (std::abs(now.y()) < 0.06) {
      slowest = std::min(slowest, (now - before).norm() / 0.001);
    }
    nearest = std::min(nearest, (now - Vec3(0.5, 0, 0.4)).norm());
    before = now;
  }
  // In the middle of the bend the tool takes the shorter way.
  EXPECT_GT(slowest, 0.5 * std::cos(turn / 2) - 1e-4);
  EXPECT_LT(nearest, 0.03 * std::sin(turn / 2));
  w.expect_kept();
}

TEST(Follower, Override_hold_and_stop_at_any_instant_keep_the_limits) {
  std::mt19937 random(31);
  for (int round = 0; round < 60; ++round) {
    Watched w(0.002);
    w.add(joints({-30, 20, 10, 0, 50, 0}, 0.1));
    w.add(joints({20, 40, -10, 30, 60, 20}, 0.1));
    w.add(pose(Move::Joint, {0.5, 0.2, 0.4}));
    for (int i = 0; i < 2000 && !w.sut.idle(); ++i) {
      if (random() % 40 == 0) {
        w.sut.set_override(static_cast<double>(random() % 101) / 100);
      }
      if (random() % 60 == 0) {
        w.sut.set_hold(random() % 2 == 0);
      }
      if (random() % 400 == 0) {
        w.sut.stop();
      }
      w.step();
    }
    w.sut.set_hold(false);
    w.sut.set_override(1);
    w.run();
    w.expect_kept();
    ASSERT_LT(w.acceleration, 1.01) << round;
    ASSERT_LT(w.jerk, 1.05) << round;
  }
}

TEST(Follower, A_stop_ends_on_the_path_and_an_emergency_stop_sooner) {
  double way[2] = {};
  for (const int hard : {0, 1}) {
    Watched w;
    w.add(joints({90, 0.2, 0, 0, 45, 0}));
    while (w.sut.speed() < 0.99) {
      w.step();
    }
    const Joints from = w.sut.joints();
    hard == 0 ? w.sut.stop() : w.sut.stop_hard(2);
    w.run();
    way[hard] = (w.sut.joints() - from).norm();
  }
  EXPECT_LT(way[1], 0.7 * way[0]);
}

TEST(Follower, An_emergency_stop_in_a_blend_is_shorter) {
  double way[2] = {};
  for (const int hard : {0, 1}) {
    Watched w;
    w.add(joints({-120, 20, 10, 0, 50, 0}));
    w.run();
    w.add(joints({0, 60, -60, 40, 60, 20}, 0.4));
    w.add(joints({120, 20, 10, 0, 50, 0}));
    while (w.sut.joints()[0] < radians(-5)) {
      w.step();
    }
    const double from = w.sut.joints()[0];
    hard == 0 ? w.sut.stop() : w.sut.stop_hard(1.5);
    w.run();
    way[hard] = w.sut.joints()[0] - from;
    EXPECT_LT(w.acceleration, hard == 0 ? 1.01 : 1.52);
    EXPECT_LT(w.velocity, 1.01);
  }
  EXPECT_LT(way[1], 0.8 * way[0]);
}

TEST(Follower, A_held_path_goes_on_to_its_end) {
  Watched w;
  w.add(joints({60, 30, -20, 10, 50, -30}));
  for (int i = 0; i < 200; ++i) {
    w.step();
  }
  w.sut.set_hold(true);
  while (!w.sut.at_rest()) {
    w.step();
  }
  const Joints here = w.sut.joints();
  for (int i = 0; i < 50; ++i) {
    w.step();
  }
  EXPECT_EQ(w.sut.joints(), here);
  w.sut.set_hold(false);
  w.run();
  w.expect_kept();
  EXPECT_NEAR(degrees(w.sut.joints()[0]), 60, 1e-9);
}

TEST(Follower, A_hold_while_it_comes_to_rest_ends_where_the_path_does) {
  for (int instant = 0; instant < 100; ++instant) {
    Watched w;
    w.add(joints({30, 12, 6, 0, 46, 0}));
    // Its limits are lower: a stop that goes on into it would be too long for what is left of the first.
    w.add(pose(Move::Line, {0.6, 0.3, 0.5}, 0.01));
    w.add(pose(Move::Line, {0.5, 0.3, 0.5}));
    while (w.sut.to_go() > 0.001 * (instant + 1)) {
      w.step();
    }
    w.sut.set_hold(true);
    for (int i = 0; i < 500; ++i) {
      w.step();
    }
    EXPECT_TRUE(w.sut.at_rest());
    w.sut.set_hold(false);
    w.run();
    w.expect_kept();
  }
}

TEST(Planner, What_cannot_work_is_known_before) {
  Watched w;
  EXPECT_EQ(w.add(pose(Move::Line, {2, 0, 0.4})).code, ErrorCode::Unreachable);
  EXPECT_EQ(w.add(joints({0, 0, 0, 0, 200, 0})).code, ErrorCode::JointLimit);
  EXPECT_EQ(w.add(joints({0, 0, 0, 0, std::nan(""), 0})).code, ErrorCode::Value);
  MoveCommand circle = pose(Move::Circle, {0.5, 0, 0.5});
  circle.mid.is_pose = true;
  circle.mid.pose.position = (w.arm.forward(w.sut.joints()).position + Vec3(0.5, 0, 0.5)) / 2;
  EXPECT_EQ(w.add(circle).code, ErrorCode::Circle);
  EXPECT_TRUE(w.sut.idle());
}

TEST(Planner, A_line_through_a_singular_position_is_refused) {
  Watched w;
  // Downwards, the tool pointing forward: where the forearm points forward too, axes 4 and 6 would have to turn half a
  // turn at once, on some nanometres.
  const auto forward = [](double z) {
    MoveCommand command = pose(Move::Line, {0.65, 1e-8, z});
    command.target.pose.orientation = from_rpy({0, kPi / 2, 0});
    return command;
  };
  MoveCommand start = forward(1.0);
  start.move = Move::Joint;
  ASSERT_TRUE(w.add(start).ok());
  w.run();
  EXPECT_EQ(w.add(forward(0.8)).code, ErrorCode::Singular);
  EXPECT_TRUE(w.add(forward(0.95)).ok());
}

}  // namespace
}  // namespace indurop::robot
