// SPDX-License-Identifier: Apache-2.0
#include "control/robot/collision/solid.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr double kNone = 1e-9;  // a shorter vector has no direction

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

// Tries the directions across its faces, and away from the axis of a cylinder.
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

// Goes from the line between the middles to the one between the nearest points: the farthest points along it give the
// next direction to try (Gilbert).
void try_nearer(const PlacedSolid& a, const PlacedSolid& b, Greatest& greatest) noexcept {
  constexpr int kTries = 16;
  Vec3 line = b.middle - a.middle;
  for (int i = 0; i < kTries && line.norm() > kNone; ++i) {
    const Vec3 direction = line.normalized();
    greatest.try_along(direction);
    const Vec3 change = b.farthest(-direction) - a.farthest(direction) - line;
    const double size = change.squaredNorm();
    if (!(size > kNone * kNone)) {
      return;
    }
    line += std::clamp(-line.dot(change) / size, 0.0, 1.0) * change;
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

Vec3 PlacedSolid::farthest(const Vec3& direction) const noexcept {
  if (kind == SolidKind::Ball) {
    return middle + half.x() * direction;
  }
  const Vec3 local = axes.transpose() * direction;
  Vec3 point(std::copysign(half.x(), local.x()), std::copysign(half.y(), local.y()),
             std::copysign(half.z(), local.z()));
  if (kind == SolidKind::Cylinder) {
    const double across = std::hypot(local.x(), local.y());
    point.x() = across > kNone ? half.x() * local.x() / across : 0;
    point.y() = across > kNone ? half.x() * local.y() / across : 0;
  }
  return middle + axes * point;
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
  constexpr double kNear = 0.1;  // m
  if (greatest.gap_seen() < kNear) {
    try_nearer(a, b, greatest);
  }
  return greatest.gap_seen();
}

}  // namespace indurop::robot
