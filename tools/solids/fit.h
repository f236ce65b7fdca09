// SPDX-License-Identifier: Apache-2.0
// The box, cylinder or ball around points that encloses least of what need not be: found by trying directions, and
// those beside the best.

#pragma once

#include <span>
#include <vector>

#include "robot/solid.h"
#include "tools/solids/mesh.h"

namespace indurop::solids {

using robot::Mat3;
using robot::Solid;

// m^3 that a solid takes if it is half a millimetre larger on all sides, so that the area of sheets counts.
double room_of(const Solid& solid) noexcept;

// Places inside of a body, evenly spread, each for so many m^3 of it. What a solid has of the body costs nothing, also
// if the points that it has to hold are elsewhere. Without places room counts.
struct Inside {
  std::vector<Vec3> places;
  double each = 0;
};
// m^3 of a solid that are not in the body, nearly.
double waste_of(const Solid& solid, const Inside& inside) noexcept;

// Along the columns of `frames` (one or more) only. Quick.
Solid fit_along(std::span<const Vec3> points, std::span<const Mat3> frames, const Inside& inside);
// Along any direction; one of `frames` is taken if it is nearly as good, since people read the file.
Solid fit(std::span<const Vec3> points, std::span<const Mat3> frames, const Inside& inside);

// Of the same kind and directions, but with a place of five decimals (m, and rad of roll, pitch and yaw) and sizes of
// four, as a file has them, around all of the points.
Solid rounded(const Solid& solid, std::span<const Vec3> points);

// The directions in which the points reach farthest and least, as columns.
Mat3 main_axes(std::span<const Vec3> points);

}  // namespace indurop::solids
