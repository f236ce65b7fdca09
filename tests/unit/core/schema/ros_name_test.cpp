// SPDX-License-Identifier: Apache-2.0
#include "core/schema/ros_name.h"

#include <gtest/gtest.h>

namespace indurop::schema {
namespace {

TEST(Ros_name, Packages_are_small_words_of_the_namespace) {
  EXPECT_EQ(ros_package("station"), "station_msgs");
  EXPECT_EQ(ros_package("knu::Robot"), "knu_robot_msgs");
  EXPECT_EQ(ros_package("PLC_ROBOT"), "plc_robot_msgs");
  EXPECT_EQ(ros_package(""), "indurop_msgs");
}

TEST(Ros_name, Messages_begin_with_a_capital_and_have_no_underscores) {
  EXPECT_EQ(ros_message("State"), "State");
  EXPECT_EQ(ros_message("joints_t"), "JointsT");
}

TEST(Ros_name, Fields_are_small_words) {
  EXPECT_EQ(ros_field("x"), "x");
  EXPECT_EQ(ros_field("dCurJoint"), "d_cur_joint");
  EXPECT_EQ(ros_field("TCPPose"), "tcp_pose");
  EXPECT_EQ(ros_field("i16"), "i16");
  EXPECT_EQ(ros_field("speed_"), "speed");
}

TEST(Ros_name, Constants_are_capitals) {
  EXPECT_EQ(ros_constant("HOLDING"), "HOLDING");
  EXPECT_EQ(ros_constant("movingFast"), "MOVING_FAST");
}

TEST(Ros_name, Topic_and_type_of_a_variable) {
  Variable variable;
  variable.name = "knu::Robot::joints";
  variable.type.base = Base::Struct;
  variable.type.name = "knu::Types::joints_t";
  EXPECT_EQ(ros_topic(variable.name), "rt/knu/Robot/joints");
  EXPECT_EQ(ros_type_name(variable), "knu_types_msgs::msg::dds_::JointsT_");
  variable.type.dims = {10};
  EXPECT_EQ(ros_type_name(variable), "knu_robot_msgs::msg::dds_::Joints_");
  variable.name = "tick";
  EXPECT_EQ(ros_type_name(variable), "indurop_msgs::msg::dds_::Tick_");
}

}  // namespace
}  // namespace indurop::schema
