// SPDX-License-Identifier: Apache-2.0
// How a motion that has a timing gets slower and faster on its way. Its pace is 1 as planned, and what the timing
// leaves of the joints' limits grows as the pace falls: by its square of accelerations, by its cube of jerks.

#pragma once

#include "robot/profile.h"

namespace indurop::robot {

// What a timing may use of the joints' limits. The rest is where a change of pace begins, so it must not be nothing.
struct TimingShares {
  static constexpr double kAcceleration = 0.95;
  static constexpr double kJerk = 0.9;
};

struct PaceLimits {
  // The least of all joints and instants of the motion as planned.
  double acceleration = 100;  // acceleration by speed
  double mixed = 1000;        // jerk by acceleration
  double jerk = 1000;         // jerk by speed
  // What the motion takes of the joints' limits.
  double acceleration_share = TimingShares::kAcceleration;
  double jerk_share = TimingShares::kJerk;

  // Of the pace while it is not above `pace`, itself 1 at most. Real-time safe, as all here.
  [[nodiscard]] LineLimits at(double pace) const noexcept;
};

class PaceChange {
 public:
  // How the pace goes on in the next `seconds` on the way to `wanted`, from 0 to 1. `now` is what came of it in the
  // last ones, or a pace that does not change.
  Profile next(const LineState& now, double wanted, double seconds, const PaceLimits& limits) noexcept;

 private:
  Profile faster(const LineState& now, double wanted, double seconds, const PaceLimits& limits) noexcept;
  Profile no_faster(const LineState& now, double wanted, const PaceLimits& limits) noexcept;

  double top_ = 0;  // while it gets faster: it can level off there, with what is left there
};

}  // namespace indurop::robot
