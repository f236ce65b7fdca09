// SPDX-License-Identifier: Apache-2.0
// Fits the box, cylinder or sphere around points with the least unnecessary volume: tries directions, then those near
// the best one.

#pragma once

#include <span>
#include <vector>

#include "control/robot/collision/solid.h"
#include "tools/solids/mesh.h"

namespace indurop::solids {

using robot::Mat3;
using robot::Solid;

// Volume in m^3 of a solid that is half a millimetre larger on all sides, so that the area of thin sheets counts.
double room_of(const Solid& solid) noexcept;

// Evenly spread points inside a body, each of which stands for a volume in m^3. The part of a solid that is inside the
// body costs nothing, even if the points that it has to contain are elsewhere. Without points the whole volume counts.
struct Inside {
  std::vector<Vec3> places;
  double each = 0;
};
// Approximate volume in m^3 of a solid that is outside the body.
double waste_of(const Solid& solid, const Inside& inside) noexcept;

// Only tries the columns of `frames` (one or more). Fast.
Solid fit_along(std::span<const Vec3> points, std::span<const Mat3> frames, const Inside& inside);
// Tries any direction; prefers one of `frames` if it is nearly as good, because people read the file.
Solid fit(std::span<const Vec3> points, std::span<const Mat3> frames, const Inside& inside);

// Returns a solid of the same kind and directions around all of the points, with its pose rounded to five decimals (m,
// and rad of roll, pitch and yaw) and its sizes to four, as in a file.
Solid rounded(const Solid& solid, std::span<const Vec3> points);

// Principal axes: the directions of largest and least extent of the points, as columns.
Mat3 main_axes(std::span<const Vec3> points);

}  // namespace indurop::solids
