// SPDX-License-Identifier: Apache-2.0
// How much larger solids are than the surface that they are around.

#pragma once

#include <cmath>
#include <vector>

#include "robot/solid.h"
#include "tools/solids/mesh.h"

namespace indurop::solids {

// Whether a solid holds a point, or nearly: up to `slack` m outside.
bool holds(const robot::Solid& solid, const Vec3& point, double slack = 0) noexcept;
// The same of a point in the directions of the solid, seen from its middle.
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
// On the skin of a solid, its corners and rims among them.
std::vector<Vec3> skin_of(const robot::Solid& solid);
// m from a point to the nearest of a surface.
double distance_to(const Surface& surface, const Vec3& point);
// Whether a closed surface is around a point (A. Van Oosterom and J. Strackee, "The solid angle of a plane triangle",
// 1983).
bool inside_of(const Surface& surface, const Vec3& point);

// m that the skin of each solid is from the surface and what it encloses at most, where no other solid hides it.
std::vector<double> each_beyond(const std::vector<robot::Solid>& solids, const Surface& surface);
// m, of all of them together.
double beyond(const std::vector<robot::Solid>& solids, const Surface& surface);

}  // namespace indurop::solids
