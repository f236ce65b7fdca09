// SPDX-License-Identifier: Apache-2.0
#include "control/robot/axis/probe.h"

#include <cmath>

#include "control/robot/axis/control.h"

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

// Permitted in any state: an axis turned by hand may be probed as well.
void AxisControl::begin_probe(int ticket, const Command& command) noexcept {
  constexpr int kFalling = 1;
  constexpr int kAtMark = 2;
  Owner owner{ticket, AxisService::TouchProbe};
  const bool windowed = command.job == 1;
  if (command.option < 0 || command.option > (kFalling | kAtMark) || (windowed && !(command.to[0] <= command.to[1]))) {
    finish(owner, ErrorCode::Value);
    return;
  }
  finish(probing_, ErrorCode::Aborted);
  probing_ = owner;
  if (ticket != kRequest) {
    table_->active(ticket);
  }
  probe_windowed_ = windowed;
  probe_first_ = command.to[0];
  probe_last_ = command.to[1];
  probe_.begin((command.option & kFalling) == 0, (command.option & kAtMark) != 0);
}

void AxisControl::abort_probe(int ticket, const Command& /*command*/) noexcept {
  Owner owner{ticket, AxisService::AbortTrigger};
  const bool was = probing_.ticket != kNobody;
  finish(probing_, ErrorCode::Aborted);
  probe_.stop();
  finish(owner, was ? ErrorCode::Ok : ErrorCode::State);
}

void AxisControl::sense_probe(const DriveIn& in) noexcept {
  if (!probe_.sense(in)) {
    return;
  }
  const double place = (probe_.counts() / scale_.counts + scale_.zero - origin_) / scale_.unit;
  if (probe_windowed_ && !(place >= probe_first_ && place <= probe_last_)) {
    probe_.again();
    return;
  }
  report_.probe = place;
  finish(probing_, ErrorCode::Ok);
}

}  // namespace indurop::robot
