// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/interrupts.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

void Interrupts::reset() noexcept {
  all_ = {};
  phase_ = Phase::None;
  count_ = 0;
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

std::size_t Interrupts::due() const noexcept {
  std::size_t found = book_.interrupts.size();
  int below = count_ > 0 ? served_[count_ - 1] : JobBook::Interrupt::kLast + 1;
  for (std::size_t i = 0; i < book_.interrupts.size(); ++i) {
    if (all_[i].pending && book_.interrupts[i].priority < below) {
      found = i;
      below = book_.interrupts[i].priority;
    }
  }
  return found;
}

// Lower priority numbers first, equal ones in the order of the book.
std::size_t Interrupts::pending(std::span<int> jobs) const noexcept {
  std::size_t count = 0;
  int next = 0;
  for (int priority = 0; next <= JobBook::Interrupt::kLast; priority = next) {
    next = JobBook::Interrupt::kLast + 1;
    for (std::size_t i = 0; i < book_.interrupts.size(); ++i) {
      const JobBook::Interrupt& one = book_.interrupts[i];
      if (!all_[i].pending || one.priority < priority) {
        continue;
      }
      if (one.priority > priority) {
        next = std::min(next, one.priority);
        continue;
      }
      if (count < jobs.size()) {
        jobs[count] = one.job;
      }
      ++count;
    }
  }
  return count;
}

int Interrupts::begin() noexcept {
  const std::size_t first = due();
  all_[first].pending = false;
  served_[count_++] = book_.interrupts[first].priority;
  phase_ = Phase::Running;
  return book_.interrupts[first].job;
}

void Interrupts::end() noexcept {
  --count_;
  cancel_leaving();
}

}  // namespace indurop::robot
