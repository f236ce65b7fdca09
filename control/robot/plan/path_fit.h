// SPDX-License-Identifier: Apache-2.0
// Finds motions that follow a guided path within a tolerance: between two marks a straight line of the tool, else a
// straight line of the axes, else a spline through as few places as it takes.

#pragma once

#include <span>
#include <vector>

#include "control/robot/kinematics/arm.h"
#include "control/robot/path/tool_path.h"

namespace indurop::robot {

struct FitPlace {
  Joints q = Joints::Zero();
  Pose tip;
  bool marked = false;
};

struct FitTolerance {
  double way = 0.001;  // m
  double turn = 0.02;  // rad
};

enum class FitKind { Line, Axes, Spline };
struct FittedMotion {
  FitKind kind = FitKind::Line;
  std::vector<std::size_t> through;  // places that it passes; the last one is its end
};
struct FittedPath {
  std::vector<FittedMotion> motions;  // the first one begins at place 0
  FitTolerance off{0, 0};             // how far they are from the path at most
};

// `arm` has the tool. The path has at least two places. Not real-time safe.
FittedPath fit_path(std::span<const FitPlace> path, const FitTolerance& tolerance, const Arm& arm,
                    const ToolLimits& tool);

}  // namespace indurop::robot
