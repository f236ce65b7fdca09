// SPDX-License-Identifier: Apache-2.0
// How an axis pushes, and how far it has come.

#pragma once

#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

// In deg/s, N m and N m/s; of an axis that slides in mm/s, N and N/s.
struct PushWay {
  int axis = 0;       // from 0
  double torque = 0;  // with a sign, in addition to what the arm needs
  double ramp = 0;    // 0: as fast as it may
  double speed = 0;   // that the axis keeps where nothing is in its way
};

struct PushState {
  bool reached = false;  // it pushes with all of the torque
  Fault error{};         // that has ended it
  double pace = 1;       // its speed, as part of the full speed of the axis
};

}  // namespace indurop::robot
