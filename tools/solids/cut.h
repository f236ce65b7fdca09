// SPDX-License-Identifier: Apache-2.0
// A surface cut by a plane. Each part gets a lid where the plane went through: so whatever is inside of a part of a
// closed surface lies between points of it along any line, and a solid around its corners holds it.

#pragma once

#include <vector>

#include "tools/solids/mesh.h"

namespace indurop::solids {

struct Plane {
  Vec3 normal = Vec3::UnitX();  // of length 1
  double at = 0;                // m along it
};

struct Parts {
  Surface below, above;
};
Parts cut(const Surface& surface, const Plane& plane);

// The corners that the two parts would have.
struct PartCorners {
  std::vector<Vec3> below, above;
};
PartCorners corners_after(const Surface& surface, const Plane& plane);

// Of all triangles, one after the other.
std::vector<Vec3> corners_of(const Surface& surface);

}  // namespace indurop::solids
