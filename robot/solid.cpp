// SPDX-License-Identifier: Apache-2.0
#include "robot/solid.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kNone = 1e-9;  // what is shorter has no direction

// The greatest gap seen along the directions that were tried.
class Greatest {
 public:
  Greatest(const PlacedSolid& a, const PlacedSolid& b) noexcept : a_(a), b_(b) {}
  void try_along(const Vec3& direction) noexcept {
    const double length = direction.norm();
    if (length > kNone) {
      gap_ = std::max(gap_, gap(a_, b_, direction / length));
    }
  }
  [[nodiscard]] double gap_seen() const noexcept { return gap_; }

 private:
  const PlacedSolid& a_;
  const PlacedSolid& b_;
  double gap_ = -HUGE_VAL;
};

// Across its faces, and away from the axis of a cylinder.
void try_faces(const PlacedSolid& one, const Vec3& between, Greatest& greatest) noexcept {
  if (one.kind == SolidKind::Ball) {
    return;
  }
  const Vec3 along = one.axes.col(2);
  greatest.try_along(along);
  if (one.kind == SolidKind::Box) {
    greatest.try_along(one.axes.col(0));
    greatest.try_along(one.axes.col(1));
  } else {
    greatest.try_along(between - between.dot(along) * along);
  }
}

}  // namespace

double Solid::radius() const noexcept {
  switch (kind) {
    case SolidKind::Box:
      return half.norm();
    case SolidKind::Cylinder:
      return std::hypot(half.x(), half.z());
    case SolidKind::Ball:
      break;
  }
  return half.x();
}

double PlacedSolid::reach(const Vec3& direction) const noexcept {
  if (kind == SolidKind::Ball) {
    return half.x();
  }
  const Vec3 local = axes.transpose() * direction;
  if (kind == SolidKind::Box) {
    return half.dot(local.cwiseAbs());
  }
  return half.x() * std::hypot(local.x(), local.y()) + half.z() * std::abs(local.z());
}

double gap(const PlacedSolid& a, const PlacedSolid& b, const Vec3& direction) noexcept {
  return std::abs((b.middle - a.middle).dot(direction)) - a.reach(direction) - b.reach(direction);
}

double least_distance(const PlacedSolid& a, const PlacedSolid& b) noexcept {
  const Vec3 between = b.middle - a.middle;
  Greatest greatest(a, b);
  greatest.try_along(between);
  try_faces(a, between, greatest);
  try_faces(b, between, greatest);
  const auto edged = [](const PlacedSolid& one) { return one.kind != SolidKind::Ball; };
  if (edged(a) && edged(b) && greatest.gap_seen() < 0) {
    // Edges that cross; a cylinder has one, its axis, along which its side runs.
    for (int i = a.kind == SolidKind::Box ? 0 : 2; i < 3; ++i) {
      for (int k = b.kind == SolidKind::Box ? 0 : 2; k < 3; ++k) {
        greatest.try_along(a.axes.col(i).cross(b.axes.col(k)));
      }
    }
  }
  return greatest.gap_seen();
}

}  // namespace indurop::robot
