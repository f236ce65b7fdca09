// SPDX-License-Identifier: Apache-2.0
#include "sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace {

constexpr double kDamping = 0.05;      // N s/mm
constexpr double kFriction = 0.2;      // part of the force on the sheet
constexpr double kFrictionSpeed = 2;   // mm/s, about, from which on it is there
constexpr double kNoise = 0.3;         // N, of the sensor, in either direction
constexpr double kToolLength = 0.120;  // m, from the arm's end to the tip

double spring(double stiffness, double depth, double speed) {
  return depth > 0 ? std::max(0.0, stiffness * depth + kDamping * speed) : 0.0;
}

}  // namespace

Sheet::Sheet(const std::string& property) : known_(!property.empty()) {
  std::istringstream text(property);
  if (known_ && !(text >> height_ >> waves_ >> length_ >> ledge_ >> stiffness_ >> ledge_stiffness_ && length_ > 0 &&
                  stiffness_ >= 0 && ledge_stiffness_ >= 0)) {
    throw std::runtime_error(
        "property sheet: it has to be six numbers: height, waves and their length, x of the ledge (mm), stiffness of "
        "sheet and ledge (N/mm)");
  }
}

// The same sequence in each run.
double Sheet::noise() {
  random_ = random_ * 1664525U + 1013904223U;
  return kNoise * (random_ / 2147483648.0 - 1);
}

std::array<double, 6> Sheet::push(const Tip& tip, double period) {
  const Tip last = before_.z == 0 ? tip : before_;
  before_ = tip;
  if (!known_) {
    return {};
  }
  const double vx = (tip.x - last.x) / period;
  const double vy = (tip.y - last.y) / period;
  const double vz = (tip.z - last.z) / period;
  const double surface = height_ + waves_ * std::sin(2 * std::numbers::pi * tip.y / length_);
  const double up = spring(stiffness_, surface - tip.z, -vz);
  const double back = spring(ledge_stiffness_, tip.x - ledge_, vx);
  const double rubs = kFriction * up / std::hypot(vx, vy, kFrictionSpeed);
  const std::array<double, 3> force{-back - rubs * vx, -rubs * vy, up};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& axis = tip.axes[i];
    measured_[i] = -(force[0] * axis[0] + force[1] * axis[1] + force[2] * axis[2]) + noise();
  }
  std::array<double, 3> arm = tip.axes[2];
  for (double& each : arm) {
    each *= kToolLength;
  }
  return {force[0],
          force[1],
          force[2],
          arm[1] * force[2] - arm[2] * force[1],
          arm[2] * force[0] - arm[0] * force[2],
          arm[0] * force[1] - arm[1] * force[0]};
}
