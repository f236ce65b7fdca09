// SPDX-License-Identifier: Apache-2.0
// A reference for motions along a path, written independently of control/robot/: how soon a path can be passed from
// rest to rest. Its limits are those of speed and acceleration, of each joint and of the path itself. It knows no jerk,
// so what is limited in jerk too cannot reach it. The path is cut into thousands of places; backwards over them goes
// what can still be braked to rest (the greatest square of the speed, found by bisection), forwards as much of it as
// can be reached: reachability as in Pham and Pham, "A new approach to time-optimal path parameterization based on
// reachability analysis" (2018).

#pragma once

#include <functional>

#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

struct TimingTask {
  std::function<Joints(double)> path;  // joint angles at x, from 0 to length
  double length = 0;
  Joints most_speed;
  Joints most_acceleration;
  double fastest = 1;  // most speed of x
  double hardest = 1;  // most acceleration of x
};

// Seconds.
double least_time(const TimingTask& task);

}  // namespace indurop::robot
