// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/model/joints.h"

#include <gmock/gmock.h>

namespace indurop::ros {
namespace {

std::string joint(const std::string& name, const std::string& type, const std::string& parent, const std::string& child,
                  const std::string& more = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         more + "</joint>\n";
}

std::vector<std::string> names_in(const std::string& joints) {
  const auto read = read_joints("arm.urdf", "<robot name='arm'>" + joints + "</robot>");
  std::vector<std::string> names;
  if (read) {
    for (const Joint& one : *read) {
      names.push_back(one.name + (one.unit < 0.002 ? " mm" : ""));
    }
  }
  return names;
}

TEST(RosJoints, Are_those_up_to_the_tool_in_the_order_of_the_chain) {
  EXPECT_THAT(names_in(joint("wrist", "revolute", "b", "tool0") + joint("rail", "prismatic", "base", "a") +
                       joint("turn", "continuous", "a", "b") + joint("finger", "prismatic", "tool0", "f") +
                       joint("screw", "revolute", "f", "g")),
              testing::ElementsAre("rail mm", "turn", "wrist"));
}

TEST(RosJoints, Without_a_tool_the_longest_chain_counts_and_what_mimics_does_not) {
  EXPECT_THAT(names_in(joint("one", "revolute", "base", "a") + joint("fixed", "fixed", "a", "b") +
                       joint("two", "revolute", "b", "c", "<mimic joint='one'/>") +
                       joint("three", "revolute", "c", "d") + joint("branch", "fixed", "a", "e")),
              testing::ElementsAre("one", "three"));
}

TEST(RosJoints, Axes_of_the_workpiece_come_after_those_of_the_arm) {
  EXPECT_THAT(names_in(joint("tilt", "revolute", "base", "cradle") + joint("one", "revolute", "base", "a") +
                       joint("two", "revolute", "a", "tool0") + joint("turn", "continuous", "cradle", "plate") +
                       "<workpiece link='plate'/>"),
              testing::ElementsAre("one", "two", "tilt", "turn"));
}

TEST(RosJoints, A_file_without_any_and_one_that_is_broken_are_errors_with_their_place) {
  const auto none = read_joints("arm.urdf", "<robot><link name='base'/></robot>");
  ASSERT_FALSE(none);
  EXPECT_THAT(base::to_text(none.error()), testing::StartsWith("arm.urdf:1:1: error: no joint moves"));
  EXPECT_FALSE(read_joints("arm.urdf", "<robot><joint></robot>"));
  EXPECT_FALSE(read_joints("arm.urdf", ""));
  // A loop is no chain without an end.
  EXPECT_THAT(names_in(joint("one", "revolute", "a", "b") + joint("two", "revolute", "b", "a")), testing::SizeIs(2));
}

}  // namespace
}  // namespace indurop::ros
