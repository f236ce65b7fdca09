// SPDX-License-Identifier: Apache-2.0
#include "control/robot/path/tool_path.h"

#include <algorithm>
#include <cmath>

#include "control/robot/path/rates.h"

namespace indurop::robot {

namespace {

// The part of the tool's acceleration and jerk across the path that bends may use; along it, what is left of the whole
// at the greatest speed.
constexpr double kAcross = 0.6;

double left(double across) noexcept {
  return std::sqrt(std::max(0.0, 1 - across * across));
}

}  // namespace

LineLimits ToolPath::limits_at(double place) const noexcept {
  const Shape shape = shape_at(place);
  const ToolLimits& tool = tool_;
  const double v = std::min({shape.speed, std::sqrt(shared(kAcross * tool.acceleration, shape.bend.norm())),
                             std::sqrt(shared(kAcross * tool.turn_acceleration, shape.turn_bend.norm())),
                             std::cbrt(shared(kAcross * tool.jerk, shape.twist.norm())),
                             std::cbrt(shared(kAcross * tool.turn_jerk, shape.turn_twist.norm()))});
  const auto along = [](double most, const Vec3& pace, double across) {
    return shared(most * left(across / most), pace.norm());
  };
  const double square = v * v;
  const double cube = square * v;
  return {v,
          std::min(along(tool.acceleration, shape.moving, square * shape.bend.norm()),
                   along(tool.turn_acceleration, shape.turning, square * shape.turn_bend.norm())),
          std::min(along(tool.jerk, shape.moving, cube * shape.twist.norm()),
                   along(tool.turn_jerk, shape.turning, cube * shape.turn_twist.norm()))};
}

}  // namespace indurop::robot
