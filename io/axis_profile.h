// SPDX-License-Identifier: Apache-2.0
// Set points on the way to a target with limited velocity and acceleration, one step at a time, whatever the motion was
// before. Real-time safe.

#pragma once

namespace indurop::io {

struct AxisProfile {
  double position = 0;
  double velocity = 0;

  // One step of `dt` towards a position; true once it has arrived and stands.
  bool go_to(double target, double most_velocity, double acceleration, double dt) noexcept;
  // One step towards a velocity; true once it is reached.
  bool change_velocity(double target, double acceleration, double dt) noexcept;
};

}  // namespace indurop::io
