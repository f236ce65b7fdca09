// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/tool_path.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

// Parts of the tool's acceleration and jerk along the path and across it, in bends: together they make up the whole.
constexpr double kAlong = 0.8;
constexpr double kAcross = 0.6;

}  // namespace

LineLimits ToolPath::limits_for(const Shape& shape, double speed, const ToolLimits& tool) noexcept {
  const double pace = shape.moving.norm();
  const double turn_pace = shape.turning.norm();
  return {std::min({speed, std::sqrt(shared(kAcross * tool.acceleration, shape.bend.norm())),
                    std::sqrt(shared(kAcross * tool.turn_acceleration, shape.turn_bend.norm())),
                    std::cbrt(shared(kAcross * tool.jerk, shape.twist.norm())),
                    std::cbrt(shared(kAcross * tool.turn_jerk, shape.turn_twist.norm()))}),
          std::min(shared(kAlong * tool.acceleration, pace), shared(kAlong * tool.turn_acceleration, turn_pace)),
          std::min(shared(kAlong * tool.jerk, pace), shared(kAlong * tool.turn_jerk, turn_pace))};
}

}  // namespace indurop::robot
