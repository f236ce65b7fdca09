// SPDX-License-Identifier: Apache-2.0
// Bodies of links, tools and zones as boxes, cylinders and balls, and how far apart two of them are at least. All are
// the same on both sides of their middle, which is what makes the formulas short.

#pragma once

#include <cstdint>

#include "robot/geometry.h"

namespace indurop::robot {

enum class SolidKind : std::uint8_t { Box, Cylinder, Ball };

struct Solid {
  SolidKind kind = SolidKind::Box;
  // m. Box: half of its edges. Cylinder, along z: its radius twice, half of its height. Ball: its radius three times.
  Vec3 half = Vec3::Zero();
  Pose place;  // of its middle, in the frame of what it belongs to

  static Solid box(const Vec3& edges, const Pose& place) noexcept { return {SolidKind::Box, edges / 2, place}; }
  static Solid cylinder(double radius, double height, const Pose& place) noexcept {
    return {SolidKind::Cylinder, {radius, radius, height / 2}, place};
  }
  static Solid ball(double radius, const Pose& place) noexcept {
    return {SolidKind::Ball, {radius, radius, radius}, place};
  }
  // m, from its middle to its farthest point.
  [[nodiscard]] double radius() const noexcept;
};

// One where the arm is now.
struct PlacedSolid {
  SolidKind kind = SolidKind::Box;
  Vec3 half = Vec3::Zero();
  Vec3 middle = Vec3::Zero();
  Mat3 axes = Mat3::Identity();

  // m that it reaches from its middle to either side along a unit vector. Real-time safe, as all here.
  [[nodiscard]] double reach(const Vec3& direction) const noexcept;
  // Its point that is farthest that way.
  [[nodiscard]] Vec3 farthest(const Vec3& direction) const noexcept;
};

// m between the planes across a unit vector that hold the two apart: never more than their distance; below 0 how far
// one has to move along it to come free.
double gap(const PlacedSolid& a, const PlacedSolid& b, const Vec3& direction) noexcept;
// The greatest of the gaps along the directions that the shapes suggest, and of some that lead nearer to the best where
// they are near to each other. Of two boxes it is below 0 only if they meet.
double least_distance(const PlacedSolid& a, const PlacedSolid& b) noexcept;

}  // namespace indurop::robot
