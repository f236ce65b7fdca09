// SPDX-License-Identifier: Apache-2.0
// Errors of motions and services, with the numbers that users see (ROBOT_ERROR in their .glb).

#pragma once

#include <indurop/robot/words.h>

namespace indurop::robot {

// An error and the axis it refers to, from 1; 0: no particular axis. For a collision: the pair that touches
// (Clearance::name), and the part of the path at which it touches; below 0: at no particular one. For a way that was
// not found: the pair that was most often in the way, and the number of tries.
struct Fault {
  ErrorCode code = ErrorCode::Ok;
  int axis = 0;
  int pair = -1;
  double part = 0;
  [[nodiscard]] bool ok() const noexcept { return code == ErrorCode::Ok; }
};

}  // namespace indurop::robot
