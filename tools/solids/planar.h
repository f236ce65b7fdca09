// SPDX-License-Identifier: Apache-2.0
// What lies around points of a plane: their hull, and the least circle and rectangle around them.

#pragma once

#include <Eigen/Core>
#include <vector>

namespace indurop::solids {

using Vec2 = Eigen::Vector2d;

// Counterclockwise, without the points on its edges (A. M. Andrew, "Another efficient algorithm for convex hulls in
// two dimensions", 1979). Of points on a line its two ends, of a single one that.
std::vector<Vec2> hull_of(std::vector<Vec2> points);

struct Circle {
  Vec2 middle = Vec2::Zero();
  double radius = 0;
};
// Of at least one point (E. Welzl, "Smallest enclosing disks", 1991; its form without recursion).
Circle least_circle(const std::vector<Vec2>& points);

struct Rectangle {
  double angle = 0;  // rad, of its first edge
  double area = 0;
};
// One edge lies along the hull (H. Freeman and R. Shapira, 1975). Of a hull of at least one point.
Rectangle least_rectangle(const std::vector<Vec2>& hull);

}  // namespace indurop::solids
