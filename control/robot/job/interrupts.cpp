// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/interrupts.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

void Interrupts::reset() noexcept {
  all_ = {};
  phase_ = Phase::None;
}

bool Interrupts::is_true(std::size_t interrupt, Signals& signals) const noexcept {
  FormulaInput in{{}, signals};
  const double value = book_.formulas[static_cast<std::size_t>(book_.interrupts[interrupt].formula)].value(in);
  return !std::isnan(value) && value != 0;
}

void Interrupts::arm(int interrupt, Signals& signals) noexcept {
  const auto i = static_cast<std::size_t>(interrupt);
  if (!all_[i].armed) {
    all_[i] = {true, is_true(i, signals), false};
  }
}

void Interrupts::disarm(int job) noexcept {
  for (std::size_t i = 0; i < book_.interrupts.size(); ++i) {
    all_[i] = book_.interrupts[i].job == job ? Monitored{} : all_[i];
  }
}

void Interrupts::monitor(Signals& signals) noexcept {
  for (std::size_t i = 0; i < book_.interrupts.size(); ++i) {
    Monitored& one = all_[i];
    if (one.armed) {
      const bool now = is_true(i, signals);
      one.pending = one.pending || (now && !one.was_true);
      one.was_true = now;
    }
  }
}

bool Interrupts::any_pending() const noexcept {
  return std::any_of(all_.begin(), all_.end(), [](const Monitored& each) { return each.pending; });
}

void Interrupts::serve_first() noexcept {
  const auto* const first = std::find_if(all_.begin(), all_.end(), [](const Monitored& each) { return each.pending; });
  served_ = static_cast<std::size_t>(first - all_.begin());
  phase_ = Phase::Leaving;
}

int Interrupts::begin() noexcept {
  all_[served_].pending = false;
  phase_ = Phase::Running;
  return book_.interrupts[served_].job;
}

}  // namespace indurop::robot
