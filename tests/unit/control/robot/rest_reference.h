// SPDX-License-Identifier: Apache-2.0
// A reference for one axis that is to come to rest somewhere, written independently of control/robot/. From rest it
// is the formula of textbooks (double S). From any state it goes forward in thousands of small steps: each has the
// greatest acceleration that leaves it both below its speed and able to stop before its target. So it keeps all limits
// and is late by less than a step.

#pragma once

namespace indurop::robot {

struct RestTask {
  double way = 0;  // to the target
  double speed = 0;
  double acceleration = 0;
  double most_speed = 1;
  double most_acceleration = 1;
  double most_jerk = 1;
};

// Seconds, of one that is at rest now.
double least_time_from_rest(const RestTask& task);
// Seconds. `steps`: about how many.
double least_time_to_rest(const RestTask& task, int steps);

}  // namespace indurop::robot
