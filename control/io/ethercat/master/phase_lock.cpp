// SPDX-License-Identifier: Apache-2.0
#include "control/io/ethercat/master/phase_lock.h"

#include <algorithm>
#include <cmath>

namespace indurop::io::ethercat {

namespace {

// Both poles at 0.99: a phase is halved in 167 periods without overshoot, and a frame that left late by chance moves
// the next period by a fiftieth of that.
constexpr double kProportional = 0.02;
constexpr double kIntegral = kProportional * kProportional / 4;
constexpr double kMost = 1e-3;  // of a period

}  // namespace

std::int64_t PhaseLock::step(std::int64_t reference_ns) noexcept {
  if (!has_grid_) {
    grid_ = reference_ns;
    has_grid_ = true;
  }
  const std::int64_t past = (reference_ns - grid_) % period_;  // in (-period, period)
  phase_ = past - (past > period_ / 2 ? period_ : 0) + (past < -period_ / 2 ? period_ : 0);
  const double most = kMost * static_cast<double>(period_);
  const auto late = static_cast<double>(phase_);
  drift_ = std::clamp(drift_ + kIntegral * late, -most, most);
  wanted_ = std::clamp(-(kProportional * late + drift_), -most, most);
  return limited();
}

std::int64_t PhaseLock::coast() noexcept {
  wanted_ = -drift_;
  return limited();
}

std::int64_t PhaseLock::limited() noexcept {
  const double whole = std::round(wanted_ + rest_);
  rest_ = wanted_ + rest_ - whole;
  return static_cast<std::int64_t>(whole);
}

}  // namespace indurop::io::ethercat
