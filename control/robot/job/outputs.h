// SPDX-License-Identifier: Apache-2.0
// The outputs of a job: set at once, during a motion, for a time, or in each period. Real-time safe.

#pragma once

#include <cstdint>

#include "control/robot/job/followed_outputs.h"
#include "control/robot/job/path_outputs.h"
#include "control/robot/job/pulses.h"
#include "control/robot/job/step_values.h"

namespace indurop::robot {

struct JobOutputs {
  PathOutputs on_path;
  Pulses pulses;
  FollowedOutputs followed;

  // Executes steps of these kinds: Set, SetOnPath. `ticket`: the last motion that was commanded. `done`: whether it has
  // been done; else it has to be tried again.
  StepValues::Flaw run(const Step& step, std::uint32_t ticket, const StepValues& values, Signals& signals,
                       const MotionPort& port, bool& done) noexcept;

 private:
  StepValues::Flaw set(const Step& step, const StepValues& values, Signals& signals, const MotionPort& port,
                       bool& done) noexcept;
};

}  // namespace indurop::robot
