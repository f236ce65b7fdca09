// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/goal.h"

#include <gmock/gmock.h>

#include <limits>

namespace indurop::ros {
namespace {

const std::vector<Joint> kJoints = {{"turn", 0.01}, {"rail", 0.001}};

RosGoal goal_with(std::vector<std::string> names, std::vector<double> positions) {
  RosGoal goal;
  goal.names = std::move(names);
  goal.points = {{1.5, std::move(positions), {}}};
  return goal;
}

TEST(RosGoal, Joints_may_be_in_any_order) {
  RosGoal goal = goal_with({"rail", "turn"}, {0.5, 2});
  goal.goal = {{"rail", 0.002}, {"turn", -1}};
  goal.path = {{"turn", 0.05}};
  goal.time_tolerance = 0.25;
  const auto axes = axes_goal(goal, kJoints);
  ASSERT_TRUE(axes);
  EXPECT_THAT(axes->points.at(0).positions, testing::ElementsAre(200, 500));
  EXPECT_EQ(axes->points.at(0).time, 1.5);
  EXPECT_THAT(axes->tolerances.goal, testing::ElementsAre(0, 2)) << "-1: any";
  EXPECT_THAT(axes->tolerances.path, testing::ElementsAre(5, 0));
  EXPECT_EQ(axes->tolerances.time, std::chrono::milliseconds(250));
}

TEST(RosGoal, Names_and_sizes_have_to_fit) {
  const auto code = [](const RosGoal& goal) {
    const auto axes = axes_goal(goal, kJoints);
    return axes ? GoalCode::Successful : axes.error().code;
  };
  EXPECT_EQ(code(goal_with({"turn"}, {1})), GoalCode::InvalidJoints);
  EXPECT_EQ(code(goal_with({"turn", "rail", "other"}, {1, 2, 3})), GoalCode::InvalidJoints);
  EXPECT_EQ(code(goal_with({"turn", "slide"}, {1, 2})), GoalCode::InvalidJoints);
  EXPECT_EQ(code(goal_with({"turn", "rail"}, {1})), GoalCode::InvalidGoal);
  RosGoal speeds = goal_with({"turn", "rail"}, {1, 2});
  speeds.points[0].velocities = {1};
  EXPECT_EQ(code(speeds), GoalCode::InvalidGoal);
}

TEST(RosGoal, A_tolerance_that_is_not_a_number_is_rejected) {
  for (const auto tolerances : {&RosGoal::path, &RosGoal::goal}) {
    RosGoal goal = goal_with({"turn", "rail"}, {1, 2});
    (goal.*tolerances) = {{"rail", std::numeric_limits<double>::quiet_NaN()}};
    const auto axes = axes_goal(goal, kJoints);
    ASSERT_FALSE(axes);
    EXPECT_EQ(axes.error().text, "the tolerance of joint 'rail' is not a number");
  }
}

TEST(RosGoal, A_set_point_is_as_far_ahead_as_its_velocities_bring_the_arm) {
  RosGoal goal = goal_with({"rail", "turn"}, {0.5, 2});
  goal.points[0].velocities = {0.1, -1};
  const auto ahead = axes_ahead(goal, kJoints, 0.1);
  ASSERT_TRUE(ahead);
  EXPECT_THAT(*ahead, testing::ElementsAre(testing::DoubleEq(190), testing::DoubleEq(510)));
}

}  // namespace
}  // namespace indurop::ros
