// SPDX-License-Identifier: Apache-2.0
// Makes a motion that has a timing slower and faster while it runs. Its pace is 1 as planned; the part of the
// joints' limits that the timing leaves grows as the pace falls: by its square for accelerations, by its cube for
// jerks.

#pragma once

#include "control/robot/path/profile.h"

namespace indurop::robot {

// The part of the joints' limits that a timing may use. The rest is where a change of pace begins, so it must not be
// zero.
struct TimingShares {
  static constexpr double kAcceleration = 0.95;
  static constexpr double kJerk = 0.9;
};

struct PaceLimits {
  // The smallest of all joints and instants of the motion as planned.
  double acceleration = 100;  // acceleration by speed
  double mixed = 1000;        // jerk by acceleration
  double jerk = 1000;         // jerk by speed
  // The part of the joints' limits that the motion uses.
  double acceleration_share = TimingShares::kAcceleration;
  double jerk_share = TimingShares::kJerk;

  // Limits of the pace while it is not above `pace`, which is at most 1. Real-time safe, like all functions of this
  // class.
  [[nodiscard]] LineLimits at(double pace) const noexcept;
};

class PaceChange {
 public:
  // Plans the pace for the next `seconds` on the way to `wanted`, from 0 to 1. `now` is the result of the last call, or
  // a constant pace.
  Profile next(const LineState& now, double wanted, double seconds, const PaceLimits& limits) noexcept;

 private:
  Profile faster(const LineState& now, double wanted, double seconds, const PaceLimits& limits) noexcept;
  Profile no_faster(const LineState& now, double wanted, const PaceLimits& limits) noexcept;

  double top_ = 0;  // while it gets faster: pace at which it can level off with the limits left there
};

}  // namespace indurop::robot
