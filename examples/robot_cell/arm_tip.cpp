// SPDX-License-Identifier: Apache-2.0
#include "arm_tip.h"

#include <cmath>
#include <numbers>

namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

using Vector = std::array<double, 3>;

// A frame that is moved and turned about its own axes, one after the other.
struct Frame {
  Vector origin{};
  std::array<Vector, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

  void move(double x, double y, double z) {
    for (std::size_t i = 0; i < 3; ++i) {
      origin[i] += x * axes[0][i] + y * axes[1][i] + z * axes[2][i];
    }
  }
  void turn(std::size_t axis, double degrees) {
    Vector& first = axes[(axis + 1) % 3];
    Vector& second = axes[(axis + 2) % 3];
    const double cosine = std::cos(degrees / kDegrees);
    const double sine = std::sin(degrees / kDegrees);
    for (std::size_t i = 0; i < 3; ++i) {
      const double before = first[i];
      first[i] = cosine * before + sine * second[i];
      second[i] = cosine * second[i] - sine * before;
    }
  }
};

}  // namespace

Tip arm_tip(const std::array<double, 6>& degrees) {
  constexpr std::size_t x = 0;
  constexpr std::size_t y = 1;
  constexpr std::size_t z = 2;
  Frame frame;
  frame.move(0, 0, 300);
  frame.turn(z, degrees[0]);
  frame.move(70, 0, 100);
  frame.turn(y, degrees[1]);
  frame.move(0, 0, 470);
  frame.turn(y, degrees[2]);
  frame.move(250, 0, 50);
  frame.turn(x, degrees[3]);
  frame.move(220, 0, 0);
  frame.turn(y, degrees[4]);
  frame.move(90, 0, 0);
  frame.turn(x, degrees[5]);
  frame.move(140, 0, 0);
  frame.turn(y, 90);
  frame.move(0, 0, 120);  // TOOL gripper
  return {frame.origin[0],
          frame.origin[1],
          frame.origin[2],
          std::atan2(frame.axes[0][1], frame.axes[0][0]) * kDegrees,
          std::acos(std::fmin(1, -frame.axes[2][2])) * kDegrees,
          frame.axes};
}
