// SPDX-License-Identifier: Apache-2.0
#include "ompl_reference.h"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <ctime>
#include <memory>

namespace indurop::robot {

OmplWay ompl_way(const Scene& scene, double seconds) {
  namespace ob = ompl::base;
  ompl::msg::noOutputHandler();
  const auto axes = static_cast<unsigned>(scene.axes());
  const auto space = std::make_shared<ob::RealVectorStateSpace>();
  for (unsigned i = 0; i < axes; ++i) {
    space->addDimension(scene.arm().joints[i].lower, scene.arm().joints[i].upper);
  }
  const auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker([&](const ob::State* state) {
    Joints q = Joints::Zero();
    for (unsigned i = 0; i < axes; ++i) {
      q[i] = state->as<ob::RealVectorStateSpace::StateType>()->values[i];
    }
    return scene.room(q, 2 * Scene::kMargin) >= Scene::kMargin;
  });
  info->setStateValidityCheckingResolution(0.005);
  info->setup();
  const auto problem = std::make_shared<ob::ProblemDefinition>(info);
  ob::ScopedState<ob::RealVectorStateSpace> start(space);
  ob::ScopedState<ob::RealVectorStateSpace> goal(space);
  for (unsigned i = 0; i < axes; ++i) {
    start[i] = scene.start[i];
    goal[i] = scene.goal[i];
  }
  problem->setStartAndGoalStates(start, goal);
  ompl::geometric::RRTConnect planner(info);
  planner.setProblemDefinition(problem);
  planner.setup();
  const std::clock_t begin = std::clock();
  const ob::PlannerStatus status = planner.solve(ob::PlannerTerminationCondition(
      [&] { return static_cast<double>(std::clock() - begin) > seconds * CLOCKS_PER_SEC; }));
  return {status == ob::PlannerStatus::EXACT_SOLUTION, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC};
}

}  // namespace indurop::robot
