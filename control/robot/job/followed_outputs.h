// SPDX-License-Identifier: Apache-2.0
// Outputs that follow an expression in each period in which the job runs, such as a flow of glue that is proportional
// to the tip's speed. Whenever the job does not run they are 0. Real-time safe.

#pragma once

#include <array>
#include <cstddef>

#include "control/robot/job/step_values.h"

namespace indurop::robot {

class FollowedOutputs {
 public:
  static constexpr std::size_t kMost = 8;

  // Executes a FOLLOW, or its end. `source`: its line.
  StepValues::Flaw run(const Step& step, int source, Signals& signals) noexcept;
  // Called once per period. `live`: the job runs and is not interrupted. If an expression has no value, `source` is the
  // line of its FOLLOW.
  StepValues::Flaw step(bool live, const StepValues& values, Signals& signals, const MotionPort& port,
                        int& source) noexcept;
  // The job has ended: all are 0 and no longer follow.
  void reset(Signals& signals) noexcept;
  // The same for outputs that are 0 already.
  void forget() noexcept { all_ = {}; }
  // Called when the output is set in another way: it no longer follows.
  void forget(std::size_t signal) noexcept;

 private:
  struct Followed {
    int formula = -1;  // -1: none
    std::size_t signal = 0;
    int source = 0;
    bool live = false;  // it may not be 0
  };
  [[nodiscard]] Followed* find(std::size_t signal) noexcept;

  std::array<Followed, kMost> all_{};
};

}  // namespace indurop::robot
