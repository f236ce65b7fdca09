// SPDX-License-Identifier: Apache-2.0
#include "tools/solids/beyond.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace indurop::solids {

namespace {

// Vector from the centre of the solid in direction `way` to its surface, in the solid's own directions. `way` is not
// zero.
Vec3 on_skin(const robot::Solid& solid, const Vec3& way) {
  if (solid.kind == robot::SolidKind::Box) {
    return way / way.cwiseAbs().cwiseQuotient(solid.half).maxCoeff();
  }
  if (solid.kind == robot::SolidKind::Cylinder) {
    return way / std::max(way.head<2>().norm() / solid.half.x(), std::abs(way.z()) / solid.half.z());
  }
  return way.normalized() * solid.half.x();
}

// Distance to the nearest point of a triangle: inside it, else on one of its edges.
double distance_to(const Triangle& triangle, const Vec3& point) {
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  bool above = normal.squaredNorm() > 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& from = triangle[i];
    const Vec3 edge = triangle[(i + 1) % 3] - from;
    above = above && normal.dot(edge.cross(point - from)) >= 0;
    const double length = edge.squaredNorm();
    const double part = length > 0 ? std::clamp((point - from).dot(edge) / length, 0.0, 1.0) : 0;
    least = std::min(least, (point - from - part * edge).norm());
  }
  return above ? std::abs(normal.normalized().dot(point - triangle[0])) : least;
}

}  // namespace

bool holds(const robot::Solid& solid, const Vec3& point, double slack) noexcept {
  return reaches(solid, solid.place.orientation.conjugate() * (point - solid.place.position), slack);
}

std::vector<Vec3> skin_of(const robot::Solid& solid) {
  constexpr int kPlaces = 400;
  constexpr int kRound = 32;
  const double golden = robot::kPi * (3 - std::sqrt(5.0));
  std::vector<Vec3> ways;
  for (int i = 0; i < kPlaces; ++i) {
    const double z = 1 - (2 * i + 1.0) / kPlaces;
    const double r = std::sqrt(1 - z * z);
    ways.emplace_back(Vec3(r * std::cos(golden * i), r * std::sin(golden * i), z).cwiseProduct(solid.half));
  }
  for (const double side : {-1.0, 1.0}) {
    if (solid.kind == robot::SolidKind::Box) {
      for (const double x : {-1.0, 1.0}) {
        ways.emplace_back(Vec3(x, -1, side).cwiseProduct(solid.half));
        ways.emplace_back(Vec3(x, 1, side).cwiseProduct(solid.half));
      }
    } else if (solid.kind == robot::SolidKind::Cylinder) {
      for (int i = 0; i < kRound; ++i) {
        const double angle = 2 * robot::kPi * i / kRound;
        ways.emplace_back(Vec3(std::cos(angle), std::sin(angle), side).cwiseProduct(solid.half));
      }
    }
  }
  for (Vec3& way : ways) {
    way = solid.place.position + solid.place.orientation * on_skin(solid, way);
  }
  return ways;
}

double distance_to(const Surface& surface, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : surface) {
    // No point of a triangle is farther from a corner than the longer edge at that corner.
    const double edge = std::max((triangle[1] - triangle[0]).norm(), (triangle[2] - triangle[0]).norm());
    if ((point - triangle[0]).norm() - edge < least) {
      least = std::min(least, distance_to(triangle, point));
    }
  }
  return least;
}

bool inside_of(const Surface& surface, const Vec3& point) {
  double angle = 0;
  for (const Triangle& triangle : surface) {
    const Vec3 a = triangle[0] - point;
    const Vec3 b = triangle[1] - point;
    const Vec3 c = triangle[2] - point;
    const double lengths = a.norm() * b.norm() * c.norm();
    const double below = lengths + a.dot(b) * c.norm() + a.dot(c) * b.norm() + b.dot(c) * a.norm();
    angle += 2 * std::atan2(a.dot(b.cross(c)), below);
  }
  return std::abs(angle) > 2 * robot::kPi;  // 4 pi if it is fully enclosed
}

std::vector<double> each_beyond(const std::vector<robot::Solid>& solids, const Surface& surface) {
  std::vector<double> found;
  for (const robot::Solid& solid : solids) {
    double most = 0;
    for (const Vec3& point : skin_of(solid)) {
      const bool hidden = std::any_of(solids.begin(), solids.end(), [&](const robot::Solid& other) {
        return &other != &solid && holds(other, point);
      });
      const double distance = hidden ? 0 : distance_to(surface, point);
      if (distance > most && !inside_of(surface, point)) {
        most = distance;
      }
    }
    found.push_back(most);
  }
  return found;
}

double beyond(const std::vector<robot::Solid>& solids, const Surface& surface) {
  const std::vector<double> each = each_beyond(solids, surface);
  return each.empty() ? 0 : *std::max_element(each.begin(), each.end());
}

}  // namespace indurop::solids
