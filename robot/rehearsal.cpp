// SPDX-License-Identifier: Apache-2.0
#include "robot/rehearsal.h"

#include <algorithm>
#include <cmath>

#include "robot/path_rates.h"

namespace indurop::robot {

namespace {

constexpr double kSure = 0.99;  // of the limits, between two instants
constexpr int kFewest = 300;    // instants: jerk of short motions peaks between the knots of their timing
constexpr int kMost = 1 << 20;

}  // namespace

void Rehearsal::begin(const Joints& from, double duration, double step, bool timed) noexcept {
  count_ = static_cast<int>(std::clamp(std::ceil(duration / step), double{kFewest}, double{kMost}));
  step_ = duration / count_;
  next_ = 1;
  worst_ = 0;
  acceleration_share_ = timed ? TimingShares::kAcceleration : Shares::kBending;
  jerk_share_ = timed ? TimingShares::kJerk : Shares::kBendingJerk;
  pace_ = {};
  seen_.fill(from);
  tip_ = TipSpeed(places_.arm());
  tip_.begin(from);
}

double Rehearsal::time() const noexcept {
  return step_ * std::min(next_, count_);  // a few instants beyond the end, where it rests
}

bool Rehearsal::look(const Segment& segment, double place) noexcept {
  Joints here = seen_[0];
  if (places_.on(segment, place, seen_[0], here) != Reach::Ok) {
    return false;
  }
  seen_ = {here, seen_[0], seen_[1], seen_[2]};
  tip_.note(here);
  const auto& q = seen_;
  const Joints first = ((q[0] - q[1]) / step_).cwiseAbs();
  const Joints second = ((q[0] - 2 * q[1] + q[2]) / (step_ * step_)).cwiseAbs();
  const Joints third = ((q[0] - 3 * q[1] + 3 * q[2] - q[3]) / (step_ * step_ * step_)).cwiseAbs();
  last_ = std::max({first.cwiseQuotient(joints_.velocity).maxCoeff(),
                    std::sqrt(second.cwiseQuotient(acceleration_share_ * joints_.acceleration).maxCoeff()),
                    std::cbrt(third.cwiseQuotient(jerk_share_ * joints_.jerk).maxCoeff())});
  worst_ = std::max(worst_, last_);
  for (int i = 0; i < kAxes; ++i) {
    pace_.acceleration = std::min(pace_.acceleration, shared(joints_.acceleration[i], first[i]));
    pace_.mixed = std::min(pace_.mixed, shared(joints_.jerk[i], second[i]));
    pace_.jerk = std::min(pace_.jerk, shared(joints_.jerk[i], first[i]));
  }
  ++next_;
  return true;
}

double Rehearsal::last_factor() const noexcept {
  return std::max(1.0, last_ / kSure);
}

double Rehearsal::factor() const noexcept {
  return std::max(1.0, worst_ / kSure);
}

}  // namespace indurop::robot
