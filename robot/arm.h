// SPDX-License-Identifier: Apache-2.0
// An arm of six axes as geometry and limits: where its tool is, and how it moves when the axes do. Axes are kept as
// lines in the base's frame at joint angles zero (product of exponentials), which any URDF can be brought to.

#pragma once

#include <array>
#include <string>

#include "robot/geometry.h"

namespace indurop::robot {

struct Axis {
  std::string name;
  Vec3 direction = Vec3::UnitZ();  // unit vector
  Vec3 point = Vec3::Zero();       // on the axis
  double lower = -kPi;             // rad
  double upper = kPi;              // rad
  bool endless = false;            // turns on and on; lower and upper do not count
};

// What the axes can do at most.
struct JointLimits {
  Joints velocity = Joints::Constant(1);      // rad/s
  Joints acceleration = Joints::Constant(4);  // rad/s^2
  Joints jerk = Joints::Constant(40);         // rad/s^3
};

class Arm {
 public:
  // `home` is the tool's pose with all joints at zero.
  Arm(std::array<Axis, kAxes> axes, const Pose& home) noexcept : axes_(std::move(axes)), home_(home) {}

  [[nodiscard]] const Axis& axis(int index) const noexcept { return axes_[static_cast<std::size_t>(index)]; }
  [[nodiscard]] const Pose& home() const noexcept { return home_; }
  // Real-time safe, as all the rest.
  [[nodiscard]] Pose forward(const Joints& q) const noexcept;
  // Of the tool's point, in the base's frame.
  [[nodiscard]] Jacobian jacobian(const Joints& q) const noexcept;
  // First axis beyond its limits by more than `slack`, from 0; -1 if none. Values that are no number are beyond.
  [[nodiscard]] int beyond_limits(const Joints& q, double slack = 1e-9) const noexcept;

 private:
  std::array<Axis, kAxes> axes_;
  Pose home_;
};

// The rotation by `angle` about the unit vector `axis`.
Mat3 turned(const Vec3& axis, double angle) noexcept;

}  // namespace indurop::robot
