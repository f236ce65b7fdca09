// SPDX-License-Identifier: Apache-2.0
#include "doors/ros/arm/goal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace indurop::ros {
namespace {

constexpr double kUsualGoal = 0.01;        // rad or m
constexpr double kUsualTimeTolerance = 5;  // s

using Places = std::vector<std::size_t>;  // of each axis in the names of a goal

Result<Places, GoalProblem> places_of(const RosGoal& goal, const std::vector<Joint>& joints) {
  Places places;
  for (const Joint& joint : joints) {
    const auto found = std::find(goal.names.begin(), goal.names.end(), joint.name);
    if (found == goal.names.end()) {
      return GoalProblem{GoalCode::InvalidJoints,
                         fmt::format("joint '{}' is missing; all joints of the arm are needed", joint.name)};
    }
    places.push_back(static_cast<std::size_t>(found - goal.names.begin()));
  }
  if (goal.names.size() != joints.size()) {
    return GoalProblem{GoalCode::InvalidJoints,
                       fmt::format("there are {} names, the arm has {} joints", goal.names.size(), joints.size())};
  }
  for (std::size_t i = 0; i < goal.points.size(); ++i) {
    const RosPoint& point = goal.points[i];
    if (point.positions.size() != joints.size() ||
        (!point.velocities.empty() && point.velocities.size() != joints.size())) {
      return GoalProblem{GoalCode::InvalidGoal,
                         fmt::format("point {} has {} positions and {} velocities; {} positions are needed", i,
                                     point.positions.size(), point.velocities.size(), joints.size())};
    }
  }
  return places;
}

std::vector<double> tolerances_of(const std::vector<RosTolerance>& given, const std::vector<Joint>& joints,
                                  double usual) {
  std::vector<double> tolerances;
  for (const Joint& joint : joints) {
    const auto found =
        std::find_if(given.begin(), given.end(), [&joint](const RosTolerance& one) { return one.name == joint.name; });
    const double chosen = found == given.end() || found->position == 0 ? usual : std::max(found->position, 0.0);
    tolerances.push_back(chosen / joint.unit);
  }
  return tolerances;
}

// Nothing would ever be beyond such a tolerance, or within it.
std::optional<GoalProblem> no_number(const std::vector<RosTolerance>& given) {
  const auto found =
      std::find_if(given.begin(), given.end(), [](const RosTolerance& one) { return std::isnan(one.position); });
  if (found == given.end()) {
    return std::nullopt;
  }
  return GoalProblem{GoalCode::InvalidGoal, fmt::format("the tolerance of joint '{}' is not a number", found->name)};
}

}  // namespace

Result<AxesGoal, GoalProblem> axes_goal(const RosGoal& goal, const std::vector<Joint>& joints) {
  const auto places = places_of(goal, joints);
  if (!places) {
    return places.error();
  }
  for (const auto* tolerances : {&goal.path, &goal.goal}) {
    if (auto problem = no_number(*tolerances)) {
      return std::move(*problem);
    }
  }
  AxesGoal axes;
  for (const RosPoint& point : goal.points) {
    TrajectoryPoint converted{point.time, {}};
    for (std::size_t axis = 0; axis < joints.size(); ++axis) {
      converted.positions.push_back(point.positions[(*places)[axis]] / joints[axis].unit);
    }
    axes.points.push_back(std::move(converted));
  }
  axes.tolerances.path = tolerances_of(goal.path, joints, 0);
  axes.tolerances.goal = tolerances_of(goal.goal, joints, kUsualGoal);
  axes.tolerances.time = std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(goal.time_tolerance > 0 ? goal.time_tolerance : kUsualTimeTolerance));
  return axes;
}

Result<std::vector<double>, GoalProblem> axes_ahead(const RosGoal& goal, const std::vector<Joint>& joints,
                                                    double ahead) {
  const auto places = places_of(goal, joints);
  if (!places) {
    return places.error();
  }
  const RosPoint& point = goal.points.back();
  std::vector<double> positions;
  for (std::size_t axis = 0; axis < joints.size(); ++axis) {
    const std::size_t place = (*places)[axis];
    const double speed = point.velocities.empty() ? 0 : point.velocities[place];
    positions.push_back((point.positions[place] + speed * ahead) / joints[axis].unit);
  }
  return positions;
}

}  // namespace indurop::ros
