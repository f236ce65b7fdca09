// SPDX-License-Identifier: Apache-2.0
// Set points of a motion to a target with limited velocity and acceleration, one step at a time, from any initial
// motion. Real-time safe.

#pragma once

namespace indurop::io {

struct AxisProfile {
  double position = 0;
  double velocity = 0;

  // One step of `dt` seconds towards a position; returns true at standstill at the target.
  bool go_to(double target, double max_velocity, double acceleration, double dt) noexcept;
  // One step towards a velocity; returns true once it is reached.
  bool change_velocity(double target, double acceleration, double dt) noexcept;
};

}  // namespace indurop::io
