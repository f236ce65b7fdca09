// SPDX-License-Identifier: Apache-2.0
// A reference for stops along a path, written independently of control/robot/: how soon a path can be braked to rest
// if each joint keeps its acceleration and its jerk. Slow and fine: the path is sampled in hundreds of places, the
// moment at which braking is taken back is bisected, for many ways to brake.

#pragma once

#include <functional>

#include "control/robot/kinematics/arm.h"

namespace indurop::robot {

struct BrakingTask {
  std::function<Joints(double)> path;  // joint angles `x` further on than now; x may be a little below 0
  double length = 0;                   // of the rest of the path
  double speed = 0;                    // of x
  double acceleration = 0;
  Joints most_acceleration;
  Joints most_jerk;
};

// Seconds until rest, of the best way found; infinite if none was.
double least_braking_time(const BrakingTask& task);

}  // namespace indurop::robot
