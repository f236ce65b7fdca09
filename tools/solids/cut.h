// SPDX-License-Identifier: Apache-2.0
// Cuts a surface by a plane. Each part gets a lid in the plane, so that every point inside a part of a closed surface
// is between points of the part along any line, and a solid around its corners contains it.

#pragma once

#include <vector>

#include "tools/solids/mesh.h"

namespace indurop::solids {

struct Plane {
  Vec3 normal = Vec3::UnitX();  // unit vector
  double at = 0;                // m along the normal
};

struct Parts {
  Surface below, above;
};
Parts cut(const Surface& surface, const Plane& plane);

// The corners of the two parts.
struct PartCorners {
  std::vector<Vec3> below, above;
};
PartCorners corners_after(const Surface& surface, const Plane& plane);

// The corners of all triangles, one after the other.
std::vector<Vec3> corners_of(const Surface& surface);

}  // namespace indurop::solids
