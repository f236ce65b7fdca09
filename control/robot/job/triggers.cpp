// SPDX-License-Identifier: Apache-2.0
// Outputs that a job sets during its motions, at a distance or time from their beginning or end.

#include <algorithm>

#include "control/robot/job/runner.h"

namespace indurop::robot {

JobRunner::Next JobRunner::set_on_path(const Step& step, Signals& signals) noexcept {
  auto* const free = std::find_if(triggers_.begin(), triggers_.end(), [](const Trigger& each) { return !each.waits; });
  if (free == triggers_.end()) {
    return Next::Wait;
  }
  double value = 0;
  if (step.formula >= 0 && !compute(step.formula, signals, value)) {
    return Next::Wait;
  }
  const bool by_time = step.timeout > 0;
  *free = {true, step.index, value, ticket_, by_time, step.mid == 1, by_time ? step.timeout : step.value, step.pulse};
  return Next::Go;
}

// Sets the outputs that are due. After the end of its motion each one is set in any case.
void JobRunner::fire(double seconds, Signals& signals, const MotionPort& port) noexcept {
  const PathPlace now = port.place();
  since_ = now.ticket == present_ ? since_ + seconds : 0;
  present_ = now.ticket > 0 ? now.ticket : present_;
  const bool settled = port.settled();
  for (Trigger& each : triggers_) {
    if (!each.waits) {
      continue;
    }
    const bool passed = settled || each.ticket < present_ || (now.ticket == 0 && each.ticket <= present_);
    bool reached = false;
    if (each.ticket == now.ticket) {
      reached = each.by_time ? (each.after ? since_ >= each.amount : now.to_go <= each.amount)
                             : (each.after ? now.gone >= each.amount : now.left <= each.amount);
    }
    if (passed || reached) {
      const auto signal = static_cast<std::size_t>(each.signal);
      if (each.pulse > 0) {
        each.waits = !pulses_.start(signal, each.pulse, signals);
        continue;
      }
      each.waits = false;
      pulses_.forget(signal);
      signals.write(signal, each.value);
    }
  }
}

}  // namespace indurop::robot
