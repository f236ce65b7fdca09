// SPDX-License-Identifier: Apache-2.0
// Draws a path in space, of a robot's tool for example, from above and from the side.

#pragma once

#include "core/base/svg.h"
#include "tools/client/recordings/recording.h"

namespace indurop::tools {

inline constexpr double kWayHeight = 400;

// Draws lines 0, 1 and, if present, 2 of the series as x, y and z, both views in the same scale, `width` wide and
// kWayHeight high from (0, 0) on. A ring marks the beginning, a disc the end. Style: classes l0, s0, grid, label, name.
base::SvgPart way_svg(const Series& series, double width);

}  // namespace indurop::tools
