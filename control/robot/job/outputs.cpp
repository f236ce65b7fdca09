// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/outputs.h"

namespace indurop::robot {

StepValues::Flaw JobOutputs::run(const Step& step, std::uint32_t ticket, const StepValues& values, Signals& signals,
                                 const MotionPort& port, bool& done) noexcept {
  done = true;
  if (step.op == Op::Set) {
    return set(step, values, signals, port, done);
  }
  done = !on_path.is_full();
  double value = 0;
  StepValues::Flaw flaw;
  if (done && step.formula >= 0) {
    flaw = values.number(step.formula, signals, port, value);
  }
  if (done && flaw.ok()) {
    const bool by_time = step.timeout > 0;
    on_path.add({step.index, value, ticket, by_time, step.mid == 1, by_time ? step.timeout : step.value, step.pulse});
  }
  return flaw;
}

StepValues::Flaw JobOutputs::set(const Step& step, const StepValues& values, Signals& signals, const MotionPort& port,
                                 bool& done) noexcept {
  const auto index = static_cast<std::size_t>(step.index);
  if (step.pulse > 0) {
    done = pulses.start(index, step.pulse, signals);
    return {};
  }
  double value = 0;
  const StepValues::Flaw flaw = values.number(step.formula, signals, port, value);
  if (flaw.ok()) {
    pulses.forget(index);
    followed.forget(index);
    signals.write(index, value);
  }
  return flaw;
}

}  // namespace indurop::robot
