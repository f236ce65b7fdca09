// SPDX-License-Identifier: Apache-2.0
// How far a wave is to the side of its path, written otherwise than in the robot task: powers of the sine instead of
// harmonics, and an integral instead of a polynomial.

#pragma once

#include <algorithm>
#include <cmath>

namespace indurop::robot {

enum class WaveShape { Sine, Triangle, Trapezoid };

inline const char* word_of(WaveShape shape) {
  return shape == WaveShape::Sine ? "SINE" : shape == WaveShape::Triangle ? "TRIANGLE" : "TRAPEZOID";
}

// All in mm: at this distance of a path that is `whole` long, for a wave from side to side and its length.
inline double wave_reference(WaveShape shape, double width, double length, double gone, double whole) {
  const double ramp = std::min(length, whole / 2);
  const double part = std::clamp(std::min(gone, whole - gone) / ramp, 0.0, 1.0);
  // What has passed by a bell of the height u^2 (1 - u)^2, by Simpson's rule, which is exact for cubics and converges
  // with the fourth power otherwise.
  constexpr int kParts = 200;
  const auto bell = [](double u) { return 30 * u * u * (1 - u) * (1 - u); };
  double swell = 0;
  for (int i = 0; i < kParts; ++i) {
    const double a = part * i / kParts;
    const double b = part * (i + 1) / kParts;
    swell += (b - a) / 6 * (bell(a) + 4 * bell((a + b) / 2) + bell(b));
  }
  constexpr double kTurn = 2 * 3.14159265358979323846;
  const double s = std::sin(kTurn * gone / length);
  const double third = 3 * s - 4 * s * s * s;  // the sine of three times the angle
  double shape_of = s;
  if (shape == WaveShape::Triangle) {
    shape_of = (9 * s - third) / 10;
  } else if (shape == WaveShape::Trapezoid) {
    shape_of = (9 * s + third) / 8;
  }
  return width / 2 * swell * shape_of;
}

}  // namespace indurop::robot
