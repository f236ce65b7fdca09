// SPDX-License-Identifier: Apache-2.0
// Bodies of links, tools and zones as boxes, cylinders and balls, and a lower bound of the distance of two of them. All
// are symmetric about their middle, which keeps the formulas short.

#pragma once

#include <cstdint>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

enum class SolidKind : std::uint8_t { Box, Cylinder, Ball };

struct Solid {
  SolidKind kind = SolidKind::Box;
  // m. Box: half of its edges. Cylinder, along z: its radius twice, half of its height. Ball: its radius three times.
  Vec3 half = Vec3::Zero();
  Pose place;  // of its middle, in the frame of the part it belongs to

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

// A solid at the present position of the arm.
struct PlacedSolid {
  SolidKind kind = SolidKind::Box;
  Vec3 half = Vec3::Zero();
  Vec3 middle = Vec3::Zero();
  Mat3 axes = Mat3::Identity();

  // m that it extends from its middle to either side along a unit vector. Real-time safe, like all functions of this
  // file.
  [[nodiscard]] double reach(const Vec3& direction) const noexcept;
  // Its farthest point in that direction.
  [[nodiscard]] Vec3 farthest(const Vec3& direction) const noexcept;
};

// m between the planes across a unit vector that separate the two: never more than their distance; if below 0, the
// distance one has to move along the vector to be free.
double gap(const PlacedSolid& a, const PlacedSolid& b, const Vec3& direction) noexcept;
// The greatest of the gaps along the directions that the shapes suggest, and, where they are close to each other, along
// some that improve the best one. For two boxes it is below 0 only if they intersect.
double least_distance(const PlacedSolid& a, const PlacedSolid& b) noexcept;

}  // namespace indurop::robot
