// SPDX-License-Identifier: Apache-2.0
// A fault in words; for a collision also the pair of bodies and the place on the path.

#pragma once

#include <cstdio>

#include "control/robot/collision/clearance.h"
#include "control/robot/kinematics/errors.h"

namespace indurop::robot {

using FaultText = char[120];

// Real-time safe.
inline void describe(const Fault& fault, const Clearance& clearance, FaultText& to) noexcept {
  if (fault.pair < 0 && fault.code == ErrorCode::NoWay && fault.part > 0) {
    std::snprintf(to, sizeof to, "no way found in %d tries; add a point between", static_cast<int>(fault.part));
    return;
  }
  if (fault.pair < 0) {
    std::snprintf(to, sizeof to, "%s", to_string(fault.code));
    return;
  }
  FaultText pair;
  constexpr int kMostOfPair = static_cast<int>(sizeof pair) - 40;
  clearance.name(fault.pair, pair, sizeof pair);
  if (fault.code == ErrorCode::NoWay) {
    std::snprintf(to, sizeof to, "no way found in %d tries, mostly because of %.*s", static_cast<int>(fault.part),
                  kMostOfPair - 16, pair);
  } else if (fault.part < 0) {
    std::snprintf(to, sizeof to, "%.*s would touch", kMostOfPair, pair);
  } else {
    std::snprintf(to, sizeof to, "%.*s would touch, after %.0f %% of the way", kMostOfPair, pair, 100 * fault.part);
  }
}

}  // namespace indurop::robot
