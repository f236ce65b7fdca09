// SPDX-License-Identifier: Apache-2.0
// A trajectory of points with their times becomes one table of each axis, which the robot task follows in time with the
// other axes (position profiles of docs/plcopen.md). Everything that the robot task would check is checked before, so
// that not one axis is refused while others move.

#pragma once

#include <indurop/result.h>
#include <indurop/robot/commands.h>

#include <string>
#include <vector>

#include "core/base/problem.h"
#include "doors/ros/arm/arm.h"

namespace indurop::ros {

struct TrajectoryPoint {
  double time = 0;                // s since the start
  std::vector<double> positions;  // of all axes, degrees or mm
};

struct TrajectoryPlan {
  std::vector<robot::ProfileTable> tables;  // of each axis
  double stretch = 1;                       // factor of all times, 1 or more: for the limits of the axes
  int slowest = -1;                         // the axis that needs it; -1: none
  double duration = 0;                      // s, stretched
  double deviation = 0;  // degrees or mm, how far the axes pass from points that are no places of the tables
};

struct TrajectoryLimits {
  double start = 0.5;      // degrees or mm between the place of an axis and where the trajectory begins
  double deviation = 0.1;  // degrees or mm, from points that do not fit into the tables
};

// The first point may have time 0. Errors: no points, times that do not rise, values that are no numbers, a start
// elsewhere, places beyond the ends of an axis, more points than fit.
Result<TrajectoryPlan, base::Problem> plan_trajectory(const std::vector<TrajectoryPoint>& points,
                                                      const std::vector<AxisNow>& axes,
                                                      const TrajectoryLimits& limits = {});

}  // namespace indurop::ros
