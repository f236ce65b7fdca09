// SPDX-License-Identifier: Apache-2.0
// Measures how far solids extend beyond the surface that they cover.

#pragma once

#include <cmath>
#include <vector>

#include "control/robot/collision/solid.h"
#include "tools/solids/mesh.h"

namespace indurop::solids {

// Returns whether a point is in a solid, or up to `slack` m outside.
bool holds(const robot::Solid& solid, const Vec3& point, double slack = 0) noexcept;
// The same for a point given in the directions of the solid, relative to its centre.
inline bool reaches(const robot::Solid& solid, const Vec3& there, double slack = 0) noexcept {
  switch (solid.kind) {
    case robot::SolidKind::Box:
      return (there.cwiseAbs().array() <= solid.half.array() + slack).all();
    case robot::SolidKind::Cylinder:
      return there.head<2>().norm() <= solid.half.x() + slack && std::abs(there.z()) <= solid.half.z() + slack;
    case robot::SolidKind::Ball:
      break;
  }
  return there.norm() <= solid.half.x() + slack;
}
// Points on the surface of a solid, including its corners and rims.
std::vector<Vec3> skin_of(const robot::Solid& solid);
// Distance in m from a point to the nearest point of a surface.
double distance_to(const Surface& surface, const Vec3& point);
// Returns whether a closed surface encloses a point (A. Van Oosterom and J. Strackee, "The solid angle of a plane
// triangle", 1983).
bool inside_of(const Surface& surface, const Vec3& point);

// Maximum distance in m of each solid's surface from the covered surface and its interior, where no other solid hides
// it.
std::vector<double> each_beyond(const std::vector<robot::Solid>& solids, const Surface& surface);
// The maximum in m over all of them.
double beyond(const std::vector<robot::Solid>& solids, const Surface& surface);

}  // namespace indurop::solids
