// SPDX-License-Identifier: Apache-2.0
// What can go wrong with a motion or service, with the numbers users see (ROBOT_ERROR in their .glb).

#pragma once

#include <indurop/robot/words.h>

namespace indurop::robot {

// An error and the axis it is about, from 1; 0: none in particular. Of a collision: what touches (Clearance::name), and
// at which part of the way; below 0: at none in particular.
struct Fault {
  ErrorCode code = ErrorCode::Ok;
  int axis = 0;
  int pair = -1;
  double part = 0;
  [[nodiscard]] bool ok() const noexcept { return code == ErrorCode::Ok; }
};

}  // namespace indurop::robot
