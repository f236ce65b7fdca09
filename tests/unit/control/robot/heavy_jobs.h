// SPDX-License-Identifier: Apache-2.0
// Random jobs of the arm of heavy_cell_arm(), with something heavy in its hand.

#pragma once

#include <fmt/core.h>

#include <random>
#include <string>

#include "heavy_arm.h"
#include "robot_fixture.h"

namespace indurop::robot {

inline Joints efforts() {
  return joints_of({250, 250, 130, 26, 22, 12});
}

inline const Body kHeld{5, Vec3(0.01, 0, 0.05), 0.01 * Mat3::Identity()};
inline constexpr const char* kLoad = "LOAD 5 kg CENTRE 10 0 50 INERTIA 0.01 0.01 0.01 0 0 0\n";

inline std::string point(const std::string& name, const Joints& q) {
  std::string text = "POINT " + name + " = JOINT";
  for (int i = 0; i < 6; ++i) {
    text += fmt::format(" {:.9f}", degrees(q[i]));
  }
  return text + "\n";
}

inline double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Joint motions anywhere; lines, circles and splines about a place in front.
inline std::string random_job(std::mt19937& random, const Arm& arm) {
  const Joints front = joints_of({between(random, -2, 2), 0.3, -0.5, 0, 0.9, 0});
  std::string points = point("FRONT", front);
  std::string steps = fmt::format("SPEED {:.0f}%\nMOVJ FRONT\n", between(random, 30, 100));
  for (int i = 0; i < 6; ++i) {
    const auto kind = random() % 5;
    const std::string name = fmt::format("Q{}", i);
    Joints q = anywhere(arm, random, 0.2);
    if (kind > 1) {
      q = front;
      for (int axis = 0; axis < 6; ++axis) {
        q[axis] += between(random, -0.25, 0.25);
      }
    }
    points += point(name, q);
    steps += random() % 3 == 0 ? fmt::format("ZONE {:.0f} mm\n", between(random, 5, 80)) : "ZONE 0\n";
    if (kind <= 1) {
      steps += "MOVJ " + name + (random() % 3 == 0 ? " STRAIGHT" : "") + "\n";
      steps += random() % 2 == 0 ? "MOVJ FRONT\n" : "";
    }
    if (kind > 1) {
      Joints other = front;
      other[0] += between(random, 0.3, 0.5);
      points += point("R" + name, other);
      steps += "MOVJ FRONT\n";
      steps += kind == 2   ? "MOVC " + name + " R" + name + "\n"
               : kind == 3 ? "MOVS " + name + " FRONT\n"
                           : "MOVL " + name + "\n";
    }
  }
  return points + kLoad + steps;
}

}  // namespace indurop::robot
