// SPDX-License-Identifier: Apache-2.0
// What a ROS client asks for, in its names and units, and what that is for the axes of the arm.

#pragma once

#include <indurop/result.h>

#include <string>
#include <vector>

#include "doors/ros/arm/follower.h"
#include "doors/ros/arm/ros_types.h"
#include "doors/ros/arm/trajectory.h"
#include "doors/ros/model/joints.h"

namespace indurop::ros {

struct GoalProblem {
  GoalCode code = GoalCode::InvalidGoal;
  std::string text;
};
struct AxesGoal {
  std::vector<TrajectoryPoint> points;
  GoalTolerances tolerances;
};

// Joints may be in any order, and all are needed. Errors: names and sizes that do not fit, and
// tolerances that are not a number.
Result<AxesGoal, GoalProblem> axes_goal(const RosGoal& goal, const std::vector<Joint>& joints);

// Where the arm has to go for one point of a stream: as far ahead as its velocities bring it in `ahead` seconds.
Result<std::vector<double>, GoalProblem> axes_ahead(const RosGoal& goal, const std::vector<Joint>& joints,
                                                    double ahead);

}  // namespace indurop::ros
