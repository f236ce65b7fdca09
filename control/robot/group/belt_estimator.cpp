// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/belt_estimator.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kQuick = 30;          // 1/s, of both filters: motions of belts take longer than 30 ms
constexpr double kJump = 5;            // mm or degrees
constexpr double kMostOfPeriod = 0.3;  // a filter must not be faster than its periods

LineState moved_on(const LineState& from, double jerk, double t) noexcept {
  return {from.position + t * (from.velocity + t * (from.acceleration / 2 + t * jerk / 6)),
          from.velocity + t * (from.acceleration + t * jerk / 2), from.acceleration + t * jerk};
}

}  // namespace

BeltEstimator::BeltEstimator(double period) noexcept
    : period_(period), pull_(std::min(kQuick, kMostOfPeriod / period)) {}

void BeltEstimator::restart() noexcept {
  received_ = 0;
  known_for_ = 0;
}

// A filter with fading memory: three equal poles, so that it does not oscillate.
void BeltEstimator::take(double place, double seconds) noexcept {
  if (received_ == 0) {
    measured_ = {place, 0, 0};
  } else if (received_ == 1) {
    measured_ = {place, (place - measured_.position) / seconds, 0};
    smooth_ = measured_;
    now_ = before_ = measured_;
    jerk_ = 0;
  } else {
    const double off = place - measured_.position;
    if (std::abs(off) > kJump) {
      jumped_ = true;
      restart();
      return;
    }
    const double keeps = std::exp(-kQuick * seconds);
    const double takes = 1 - keeps;
    measured_.position += (1 - keeps * keeps * keeps) * off;
    measured_.velocity += 1.5 * takes * takes * (1 + keeps) / seconds * off;
    measured_.acceleration += takes * takes * takes / (seconds * seconds) * off;
  }
  received_ = std::min(received_ + 1, 2);
}

void BeltEstimator::sense(const BeltIn& in) noexcept {
  const bool fresh = !first_ && in.beat != beat_;
  first_ = false;
  beat_ = in.beat;
  silent_ += period_;
  if (!std::isfinite(in.place) || silent_ > kPatience) {
    restart();
  }
  if (received_ == 2) {
    measured_ = moved_on(measured_, 0, period_);
    smooth_ = moved_on(smooth_, jerk_, period_);
    known_for_ += period_;
    jumped_ = jumped_ && !known();
  }
  if (fresh && std::isfinite(in.place)) {
    take(in.place, silent_);
    silent_ = 0;
  }
  if (received_ < 2) {
    return;
  }
  jerk_ =
      pull_ * (pull_ * (pull_ * (measured_.position - smooth_.position) + 3 * (measured_.velocity - smooth_.velocity)) +
               3 * (measured_.acceleration - smooth_.acceleration));
  before_ = now_;
  const double velocity = (smooth_.position - before_.position) / period_;
  now_ = {smooth_.position, velocity, (velocity - before_.velocity) / period_};
}

}  // namespace indurop::robot
