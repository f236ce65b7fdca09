// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/planar.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace indurop::solids {

namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Adds one of the two chains of the hull, in the order of the points.
template <class Iterator>
void add_chain(Iterator begin, Iterator end, std::vector<Vec2>& hull) {
  const std::size_t first = hull.size();
  for (auto point = begin; point != end; ++point) {
    while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), *point) <= 0) {
      hull.pop_back();
    }
    hull.push_back(*point);
  }
  hull.pop_back();  // it is the begin of the other chain
}

bool outside(const Circle& circle, const Vec2& point) {
  return (point - circle.middle).norm() > circle.radius * (1 + 1e-12) + 1e-15;
}

Circle around(const Vec2& a, const Vec2& b) {
  return {(a + b) / 2, (a - b).norm() / 2};
}

Circle around(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 ab = b - a;
  const Vec2 ac = c - a;
  const double twice = 2 * (ab.x() * ac.y() - ab.y() * ac.x());
  if (std::abs(twice) <= 1e-14 * ab.norm() * ac.norm()) {  // collinear: uses the two points that are farthest apart
    const Circle pairs[] = {around(a, b), around(a, c), around(b, c)};
    return *std::max_element(std::begin(pairs), std::end(pairs),
                             [](const Circle& one, const Circle& other) { return one.radius < other.radius; });
  }
  const Vec2 from_a = Vec2(ac.y() * ab.squaredNorm() - ab.y() * ac.squaredNorm(),
                           ab.x() * ac.squaredNorm() - ac.x() * ab.squaredNorm()) /
                      twice;
  return {a + from_a, from_a.norm()};
}

}  // namespace

std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  const auto before = [](const Vec2& a, const Vec2& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) {
    return points;
  }
  std::vector<Vec2> hull;
  add_chain(points.begin(), points.end(), hull);
  add_chain(points.rbegin(), points.rend(), hull);
  return hull;
}

Circle least_circle(const std::vector<Vec2>& points) {
  Circle circle{points.front(), 0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!outside(circle, points[i])) {
      continue;
    }
    circle = {points[i], 0};
    for (std::size_t j = 0; j < i; ++j) {
      if (!outside(circle, points[j])) {
        continue;
      }
      circle = around(points[i], points[j]);
      for (std::size_t k = 0; k < j; ++k) {
        if (outside(circle, points[k])) {
          circle = around(points[i], points[j], points[k]);
        }
      }
    }
  }
  return circle;
}

Rectangle least_rectangle(const std::vector<Vec2>& hull) {
  Rectangle least{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 edge = hull[(i + 1) % hull.size()] - hull[i];
    const double angle = edge.isZero(0) ? 0 : std::atan2(edge.y(), edge.x());
    const Vec2 along(std::cos(angle), std::sin(angle));
    const Vec2 across(-along.y(), along.x());
    Eigen::AlignedBox2d extent;
    for (const Vec2& point : hull) {
      extent.extend(Vec2(point.dot(along), point.dot(across)));
    }
    if (extent.volume() < least.area) {
      least = {angle, extent.volume()};
    }
  }
  return least;
}

}  // namespace indurop::solids
