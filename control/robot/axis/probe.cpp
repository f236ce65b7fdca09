// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/probe.h"

namespace indurop::robot {

namespace {

// Bits of the touch probe function.
constexpr unsigned kOn = 1U << 0U;
constexpr unsigned kMark = 1U << 2U;
constexpr unsigned kRise = 1U << 4U;
constexpr unsigned kFall = 1U << 5U;
// Bits of the touch probe status; bit 0 is kOn.
constexpr unsigned kStoredRise = 1U << 1U;
constexpr unsigned kStoredFall = 1U << 2U;

}  // namespace

void AxisProbe::begin(bool rising, bool mark) noexcept {
  rising_ = rising;
  mark_ = mark;
  step_ = Step::Clearing;
}

bool AxisProbe::sense(const DriveIn& in) noexcept {
  if (step_ == Step::Clearing && (in.probe & (kOn | kStoredRise | kStoredFall)) == 0) {
    step_ = Step::Armed;
  } else if (step_ == Step::Armed && (in.probe & (rising_ ? kStoredRise : kStoredFall)) != 0) {
    counts_ = rising_ ? in.probe_rise : in.probe_fall;
    step_ = Step::Idle;
    return true;
  }
  return false;
}

std::uint16_t AxisProbe::function() const noexcept {
  if (step_ != Step::Armed) {
    return 0;
  }
  return static_cast<std::uint16_t>(kOn | (mark_ ? kMark : 0U) | (rising_ ? kRise : kFall));
}

}  // namespace indurop::robot
