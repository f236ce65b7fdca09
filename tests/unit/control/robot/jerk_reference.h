// SPDX-License-Identifier: Apache-2.0
// A second reference for motions along a path, which knows limits of jerk too, written independently of
// control/robot/. The unknowns are the places at instants equally far apart and how far that is; what is limited are
// differences of joint angles between instants, as a drive sees them. A log barrier over all of it goes down by
// Gauss-Newton steps from a slow motion. What comes out keeps all limits, so the least time is not above it; that it is
// not far below shows where the least time is known, and by the yardstick without jerk.

#pragma once

#include "topp_reference.h"

namespace indurop::robot {

struct JerkTask {
  TimingTask speeds;  // limits of speed and acceleration
  Joints most_jerk;
  double jerk = 1;  // most of x
};

// Seconds; 0 if it finds no beginning.
double least_time(const JerkTask& task);

}  // namespace indurop::robot
