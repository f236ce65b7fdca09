// SPDX-License-Identifier: Apache-2.0
// Where an axis comes to rest if it has to stop. A path may turn an axis back just before its limit while it still
// decelerates; the last gate does not know the path and stops such an axis, because it could not rest before its limit.

#pragma once

#include "control/robot/path/profile.h"

namespace indurop::robot {

// How far an axis goes at most in the positive direction if it stops as fast as its limits allow, at least 0, in rad or
// m. With a deceleration that cannot be reduced in time it goes back at last; it has been this far then. Real-time
// safe.
[[nodiscard]] double farthest_at_stop(double velocity, double acceleration, const LineLimits& limits) noexcept;

// Factor by which a motion has to become slower, at least 1, so that such a stop ends within `room` rad or m, which is
// at least 0. It is at most `most`. Real-time safe.
[[nodiscard]] double slower_for_rest(double room, double velocity, double acceleration, const LineLimits& limits,
                                     double most) noexcept;

}  // namespace indurop::robot
