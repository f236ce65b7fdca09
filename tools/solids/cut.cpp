// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/cut.h"

#include <array>
#include <cstddef>

#include "tools/solids/planar.h"

namespace indurop::solids {

namespace {

// A triangle with a corner cut off has four.
struct Outline {
  std::array<Vec3, 4> corners;
  std::size_t count = 0;

  void add(const Vec3& corner) { corners[count++] = corner; }
};

struct Divided {
  Outline below, above, both;  // `both`: points in the plane
};

Divided divide(const Triangle& triangle, const Plane& plane) {
  Divided divided;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& here = triangle[i];
    const Vec3& next = triangle[(i + 1) % 3];
    const double a = here.dot(plane.normal) - plane.at;
    const double b = next.dot(plane.normal) - plane.at;
    if (a <= 0) {
      divided.below.add(here);
    }
    if (a >= 0) {
      divided.above.add(here);
    }
    if (a == 0) {
      divided.both.add(here);
    }
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      const Vec3 between = here + (next - here) * (a / (a - b));
      divided.below.add(between);
      divided.above.add(between);
      divided.both.add(between);
    }
  }
  return divided;
}

void add_triangles(const Outline& outline, Surface& to) {
  for (std::size_t i = 2; i < outline.count; ++i) {
    to.push_back({outline.corners[0], outline.corners[i - 1], outline.corners[i]});
  }
}

void add_corners(const Outline& outline, std::vector<Vec3>& to) {
  to.insert(to.end(), outline.corners.begin(), outline.corners.begin() + static_cast<std::ptrdiff_t>(outline.count));
}

// Adds the hull of the points in the plane: for a part with a hollow larger than the lid, never smaller.
void add_lid(const std::vector<Vec3>& rim, const Plane& plane, Surface& to) {
  const Vec3 right = plane.normal.unitOrthogonal();
  const Vec3 up = plane.normal.cross(right);
  std::vector<Vec2> flat;
  flat.reserve(rim.size());
  for (const Vec3& point : rim) {
    flat.emplace_back(point.dot(right), point.dot(up));
  }
  const std::vector<Vec2> hull = hull_of(std::move(flat));
  const auto back = [&](const Vec2& point) {
    return Vec3(point.x() * right + point.y() * up + plane.at * plane.normal);
  };
  for (std::size_t i = 2; i < hull.size(); ++i) {
    to.push_back({back(hull[0]), back(hull[i - 1]), back(hull[i])});
  }
}

}  // namespace

Parts cut(const Surface& surface, const Plane& plane) {
  Parts parts;
  std::vector<Vec3> rim;
  for (const Triangle& triangle : surface) {
    const Divided divided = divide(triangle, plane);
    add_triangles(divided.below, parts.below);
    add_triangles(divided.above, parts.above);
    add_corners(divided.both, rim);
  }
  add_lid(rim, plane, parts.below);
  add_lid(rim, plane, parts.above);
  return parts;
}

PartCorners corners_after(const Surface& surface, const Plane& plane) {
  PartCorners corners;
  for (const Triangle& triangle : surface) {
    const Divided divided = divide(triangle, plane);
    add_corners(divided.below, corners.below);
    add_corners(divided.above, corners.above);
  }
  return corners;
}

std::vector<Vec3> corners_of(const Surface& surface) {
  std::vector<Vec3> corners;
  corners.reserve(3 * surface.size());
  for (const Triangle& triangle : surface) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return corners;
}

}  // namespace indurop::solids
