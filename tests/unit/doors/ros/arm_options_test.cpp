// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/arm_options.h"

#include <gmock/gmock.h>

namespace indurop::ros {
namespace {

TEST(RosNames, Are_as_ROS_has_them) {
  for (const char* const name : {"arm_controller", "/cell", "cell/left_2", "/_a/B9"}) {
    EXPECT_EQ(ros_name_problem(name), "") << name;
  }
  for (const char* const name : {"", "/", "2nd", "cell/", "cell//left", "a-b", "a b", "cell/7", "//cell"}) {
    EXPECT_NE(ros_name_problem(name), "") << name;
  }
}

}  // namespace
}  // namespace indurop::ros
