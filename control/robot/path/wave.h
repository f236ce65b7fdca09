// SPDX-License-Identifier: Apache-2.0
// A wave across a path of the tool, such as a welding torch makes: how far to the side at each distance on the path. It
// is a function of the distance alone, so it is the same at any speed; it grows over the first wave and fades over the
// last one, so that the path begins and ends exactly where it would without it.

#pragma once

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

// A place on a path: the distance from its start, its length, and a vector in the direction of the motion.
struct PathWay {
  double gone = 0, whole = 0;  // m
  Vec3 moving = Vec3::Zero();
};

struct Wave {
  // Parts of the third harmonic that make sides nearly straight with round corners, and sides on which it lingers.
  static constexpr double kTriangle = -1.0 / 9, kTrapezoid = 1.0 / 9;

  double width = 0;   // m, from side to side; 0: there is no wave
  double length = 0;  // m of the path, of one wave
  double third = 0;   // part of the third harmonic; 0: a sine
  double turned = 0;  // rad, about the direction of the motion, of the plane of the wave

  // All functions are real-time safe.
  [[nodiscard]] bool on() const noexcept { return width > 0; }
  // Part of the width that counts at this place, from 0 to 1.
  [[nodiscard]] static double swell(double gone, double whole, double length) noexcept;
  // m to the side; positive values first.
  [[nodiscard]] double at(double gone, double whole) const noexcept;
  // The largest derivatives by the distance, away from both ends: without unit, 1/m, 1/m^2.
  struct Steepness {
    double slope = 0, bend = 0, twist = 0;
  };
  [[nodiscard]] Steepness steepness() const noexcept;
  // The direction of its first side, 1 long: left of the motion, seen against the tool's z axis, turned about the
  // motion by `turned`. 0 if the tool points along the path, within 10 degrees.
  [[nodiscard]] Vec3 side(const Vec3& moving, const Quat& tool) const noexcept;
  // The pose of the tool that is at `pose` without the wave.
  [[nodiscard]] Pose shifted(Pose pose, const PathWay& way) const noexcept;
};

}  // namespace indurop::robot
