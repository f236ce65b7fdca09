// SPDX-License-Identifier: Apache-2.0
// Why measured points give no result: what they lack, and what to add. Not real-time safe.

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

// m, that one point may be off
inline constexpr double kMostTipError = 0.005;
inline constexpr double kMostFrameError = 0.005;
inline constexpr double kMostCameraError = 0.01;

// Returns "a tool needs 4 points that ... or more; there are 2".
std::string too_few(const char* what, const char* points, std::size_t least, std::size_t count);
// Returns why, unless so many of these positions of the arm's end are turned differently from all others.
std::string too_alike(std::span<const Pose> ends, std::size_t least);
// Returns why, if the worst point is off by more than allowed.
std::string too_far(double most, std::size_t worst, double allowed);
// Returns whether these positions differ enough in their orientation, about two axes, to show a place that moves with
// the arm's end: an error of one mm becomes one of 12 mm at most.
bool turned_enough(std::span<const Pose> ends);

}  // namespace indurop::robot
