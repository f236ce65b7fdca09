// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/followed_outputs.h"

#include <indurop/robot/controller.h>

#include <algorithm>

namespace indurop::robot {

FollowedOutputs::Followed* FollowedOutputs::find(std::size_t signal) noexcept {
  auto* const found = std::find_if(all_.begin(), all_.end(),
                                   [&](const Followed& one) { return one.formula >= 0 && one.signal == signal; });
  return found == all_.end() ? nullptr : found;
}

StepValues::Flaw FollowedOutputs::run(const Step& step, int source, Signals& signals) noexcept {
  const auto signal = static_cast<std::size_t>(step.index);
  Followed* place = find(signal);
  if (step.formula < 0) {
    forget(signal);
    signals.write(signal, 0);
    return {};
  }
  if (place == nullptr) {
    place = std::find_if(all_.begin(), all_.end(), [](const Followed& one) { return one.formula < 0; });
  }
  if (place == all_.end()) {
    return {"8 outputs follow expressions already, and no more can; end one with FOLLOW and OFF"};
  }
  *place = {step.formula, signal, source, true};
  return {};
}

StepValues::Flaw FollowedOutputs::step(bool live, const StepValues& values, Signals& signals, const MotionPort& port,
                                       int& source) noexcept {
  StepValues::Flaw flaw;
  for (Followed& one : all_) {
    double value = 0;
    if (live && one.formula >= 0 && flaw.ok()) {
      flaw = values.number(one.formula, signals, port, value);
      source = one.source;
    }
    const bool follows = live && flaw.ok();
    if (one.formula >= 0 && (follows || one.live)) {
      signals.write(one.signal, follows ? value : 0);
      one.live = follows;
    }
  }
  return flaw;
}

void FollowedOutputs::reset(Signals& signals) noexcept {
  for (const Followed& one : all_) {
    if (one.formula >= 0) {
      signals.write(one.signal, 0);
    }
  }
  forget();
}

void FollowedOutputs::forget(std::size_t signal) noexcept {
  if (Followed* const one = find(signal); one != nullptr) {
    *one = {};
  }
}

}  // namespace indurop::robot
