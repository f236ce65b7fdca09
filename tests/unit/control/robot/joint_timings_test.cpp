// SPDX-License-Identifier: Apache-2.0
// Timings of joint motions alone; joint_motion_test.cpp checks what the joints do.
#include <gtest/gtest.h>

#include "control/robot/path/joint_motions.h"
#include "robot_fixture.h"

namespace indurop::robot {
namespace {

class Joint_motions : public testing::Test {
 protected:
  static Segment motion(const Joints& from, const Joints& to) {
    Segment segment = Segment::together_to(to, 1);
    segment.from = from;
    return segment;
  }

  Arm arm = cell_arm();
  Inverse inverse{arm};
  Places places{arm, inverse};
  JointLimits limits = cell_limits();
  JointMotions sut{places, limits};
  Joints from = Joints::Constant(0.1);
  Joints to = Joints::Constant(0.9);
};

TEST_F(Joint_motions, Are_timed_for_a_pace_at_which_the_tip_keeps_its_limit) {
  Segment free = motion(from, to);
  sut.time(free, 1);
  EXPECT_DOUBLE_EQ(free.made_for, 1);
  const double fastest = sut.tip_speed_of(free);
  ASSERT_GT(fastest, 0.2);

  sut.set_tip_limit(fastest / 4);
  EXPECT_DOUBLE_EQ(sut.pace_for(fastest), 0.25);
  EXPECT_DOUBLE_EQ(sut.pace_for(fastest / 5), 1);
  Segment slow = motion(from, to);
  sut.time(slow, 1);
  EXPECT_LT(slow.made_for, 1);
}

TEST_F(Joint_motions, Begin_in_motion_only_if_no_joint_has_to_pass_its_limit) {
  JointMotions::Beginning beginning;
  beginning.moving = true;
  beginning.now.position = from;
  beginning.now.velocity[1] = limits.velocity[1] / 2;
  Segment segment = motion(from, to);
  EXPECT_TRUE(sut.begin(segment, beginning, 1).ok());
  EXPECT_TRUE(segment.moving);
  EXPECT_NEAR(segment.joint_timing.at(0).velocity[1], limits.velocity[1] / 2, 1e-9);

  beginning.now.position[1] = arm.axis(1).upper - 1e-4;
  const Fault fault = sut.begin(segment, beginning, 1);
  EXPECT_EQ(fault.code, ErrorCode::JointLimit);
  EXPECT_EQ(fault.axis, 2);
}

}  // namespace
}  // namespace indurop::robot
