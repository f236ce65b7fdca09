// SPDX-License-Identifier: Apache-2.0
// The statements of the running job that stay in force, or take more than a period.

#pragma once

#include "control/robot/job/correcting.h"
#include "control/robot/job/pushing.h"
#include "control/robot/job/riding.h"

namespace indurop::robot {

struct LongStatements {
  Correcting correcting;
  Riding riding;
  Pushing pushing;

  // A job is started.
  void reset() noexcept {
    correcting.reset();
    riding.reset();
    pushing.reset();
  }
  // Records a step before the one at which the job starts.
  void skip(const Step& step) noexcept {
    correcting.skip(step);
    riding.skip(step);
  }
  // Returns whether the robot is not on a path to which it can return after an interrupt.
  [[nodiscard]] bool off_path() const noexcept { return correcting.on() || riding.rides() || pushing.on(); }
  // Ends them where all motions end. Returns false if it is not done yet.
  bool end(MotionPort& port) noexcept { return correcting.end(port) && riding.end(port); }
};

}  // namespace indurop::robot
