// SPDX-License-Identifier: Apache-2.0
// A fault in words; for a collision also the pair of bodies and the place on the path, for a drive its axis.

#pragma once

#include <cstdio>
#include <cstring>

#include "control/robot/collision/clearance.h"
#include "control/robot/kinematics/arm.h"
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

// "axis 7 (turn): a drive reports a fault"; of an end of its range, also where that is.
inline void name_axis(const Fault& fault, const Axis& axis, FaultText& to) noexcept {
  const double unit = axis.slides() ? 0.001 : kPi / 180;
  if (fault.code == ErrorCode::JointLimit) {
    std::snprintf(to, sizeof to, "axis %d (%.24s) would leave its range, %.6g to %.6g %s", fault.axis,
                  axis.name.c_str(), axis.lowest() / unit, axis.highest() / unit, axis.slides() ? "mm" : "degrees");
  } else {
    std::snprintf(to, sizeof to, "axis %d (%.24s): %s", fault.axis, axis.name.c_str(), to_string(fault.code));
  }
}
// The same if the fault has an axis.
inline void name_axis(const Fault& fault, const Arm& arm, FaultText& to) noexcept {
  if (fault.axis < 1 || fault.axis > arm.count()) {
    std::snprintf(to, sizeof to, "%s", to_string(fault.code));
    return;
  }
  name_axis(fault, arm.axis(fault.axis - 1), to);
}

// Adds "; axis 7 ends at 90 degrees" for each axis that moves the workpiece: the pose of a motion that is out of reach
// may be in reach where they are elsewhere. `end`: the joints at the end of the motion.
inline void add_workpiece(const Arm& arm, const Joints& end, FaultText& to) noexcept {
  for (int i = 0; i < arm.count(); ++i) {
    if (arm.moves_workpiece(i)) {
      const bool slides = arm.axis(i).slides();
      const std::size_t length = std::strlen(to);
      std::snprintf(to + length, sizeof to - length, "; axis %d ends at %.5g %s", i + 1,
                    slides ? 1000 * end[i] : degrees(end[i]), slides ? "mm" : "degrees");
    }
  }
}

}  // namespace indurop::robot
