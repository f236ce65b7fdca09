// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/followed_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Followed_path : public testing::Test {
 protected:
  // A joint motion of 1 s at full speed; the second one continues the first.
  static Segment segment(double from, double to) {
    Segment s;
    s.from.setConstant(from);
    s.to.setConstant(to);
    s.length = 1;
    s.limits = {1, 100, 10000};
    s.source = to > 0.15 ? 2 : 1;
    return s;
  }
  static Blend blend() {
    Blend wanted;
    wanted.zone = 0.1;
    wanted.limits = {0.5, 100, 10000};
    return wanted;
  }
  Joints at(double place) const {
    Joints q = Joints::Zero();
    EXPECT_EQ(sut.joints_at(place, q, q), Reach::Ok);
    return q;
  }

  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  FollowedPath sut{places};
};

TEST_F(Followed_path, Goes_from_piece_to_piece) {
  sut.add(segment(0, 0.1), {});
  sut.add(segment(0.1, 0.2), blend());
  EXPECT_DOUBLE_EQ(sut.left(), 1);
  EXPECT_EQ(sut.smooth_until(0), HUGE_VAL);
  ASSERT_TRUE(sut.begin_blend());
  EXPECT_FALSE(sut.begin_blend()) << "it is decided once";
  EXPECT_DOUBLE_EQ(sut.piece_end(), 0.9);
  EXPECT_DOUBLE_EQ(sut.left(), 2);
  EXPECT_DOUBLE_EQ(sut.smooth_until(0), 0.9);
  EXPECT_DOUBLE_EQ(sut.smooth_until(1), 1.1);
  sut.go(1);
  EXPECT_TRUE(sut.in_blend());
  EXPECT_NEAR(sut.state().position, 0.1, 1e-12);
  sut.go(0.2);
  EXPECT_FALSE(sut.in_blend());
  EXPECT_EQ(sut.source(), 2);
  EXPECT_NEAR(sut.state().position, 0.2, 1e-12);
  EXPECT_NEAR(sut.left(), 0.8, 1e-12);
  EXPECT_TRUE(sut.next_piece());
  EXPECT_TRUE(sut.empty());
  EXPECT_EQ(sut.source(), 0);
}

TEST_F(Followed_path, Is_blended_only_while_the_speed_of_the_blend_can_be_reached) {
  sut.add(segment(0, 0.1), {});
  sut.add(segment(0.1, 0.2), blend());
  sut.set_state({0.9 - 1e-4, 1, 0});
  EXPECT_FALSE(sut.begin_blend());
  sut.set_state({0.5, 1, 0});
  EXPECT_TRUE(sut.begin_blend());
}

TEST_F(Followed_path, Is_kept_and_taken_where_it_was_left_and_followed_more_gently_then) {
  sut.add(segment(0, 0.1), {});
  sut.add(segment(0.1, 0.2), blend());
  ASSERT_TRUE(sut.begin_blend());
  sut.set_state({0.4, 1, 0});
  const Joints here = at(0.4);
  KeptPath kept;
  sut.keep(here, kept);
  ASSERT_TRUE(kept.known());
  sut.clear();
  EXPECT_TRUE(sut.empty());

  sut.take(kept);
  EXPECT_FALSE(kept.known());
  EXPECT_EQ(sut.pieces().count, 2);
  EXPECT_DOUBLE_EQ(sut.state().position, 0.4);
  EXPECT_DOUBLE_EQ(sut.state().velocity, 0);
  EXPECT_DOUBLE_EQ(sut.blend().zone, 0.1);
  EXPECT_TRUE(at(0.4).isApprox(here));
  const double velocity = sut.segment().limits.velocity;
  EXPECT_LT(velocity, 1);
  sut.keep(here, kept);
  sut.take(kept);
  EXPECT_DOUBLE_EQ(sut.segment().limits.velocity, velocity) << "left twice";
}

TEST_F(Followed_path, Computes_the_motion_of_the_joints) {
  sut.add(segment(0, 0.1), {});
  sut.set_state({0.5, 0.5, 1});
  JointState now;
  ASSERT_EQ(sut.motion(at(0.5), now), Reach::Ok);
  for (int i = 0; i < kAxes; ++i) {
    EXPECT_NEAR(now.velocity[i], 0.05, 1e-6);
    EXPECT_NEAR(now.acceleration[i], 0.1, 1e-3);
  }
}

}  // namespace
}  // namespace indurop::robot
