// SPDX-License-Identifier: Apache-2.0
// Geometry of points in a plane: their hull, and the smallest circle and rectangle around them.

#pragma once

#include <Eigen/Core>
#include <vector>

namespace indurop::solids {

using Vec2 = Eigen::Vector2d;

// Returns the hull counterclockwise, without the points on its edges (A. M. Andrew, "Another efficient algorithm for
// convex hulls in two dimensions", 1979). For points on a line its two ends, for a single point that point.
std::vector<Vec2> hull_of(std::vector<Vec2> points);

struct Circle {
  Vec2 middle = Vec2::Zero();
  double radius = 0;
};
// For at least one point (E. Welzl, "Smallest enclosing disks", 1991; the variant without recursion).
Circle least_circle(const std::vector<Vec2>& points);

struct Rectangle {
  double angle = 0;  // direction of its first edge in rad
  double area = 0;
};
// One edge is along the hull (H. Freeman and R. Shapira, 1975). The hull has at least one point.
Rectangle least_rectangle(const std::vector<Vec2>& hull);

}  // namespace indurop::solids
