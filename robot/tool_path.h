// SPDX-License-Identifier: Apache-2.0
// A way of the tool that is made of many pieces, as the planner sees it: where the tool is at each place, and what it
// and the commands allow of the speed there. Places are seconds at full speed.

#pragma once

#include "robot/geometry.h"
#include "robot/profile.h"

namespace indurop::robot {

// How fast the tool may move.
struct ToolLimits {
  double velocity = 1;            // m/s
  double acceleration = 5;        // m/s^2
  double jerk = 50;               // m/s^3
  double turn_velocity = kPi;     // rad/s
  double turn_acceleration = 20;  // rad/s^2
  double turn_jerk = 200;         // rad/s^3
};

inline ToolLimits gentler(ToolLimits limits, double part) noexcept {
  limits.acceleration *= part;
  limits.jerk *= part;
  limits.turn_acceleration *= part;
  limits.turn_jerk *= part;
  return limits;
}

class ToolPath {
 public:
  virtual ~ToolPath() = default;

  // Real-time safe, as all here.
  [[nodiscard]] virtual Pose pose_at(double place) const noexcept = 0;
  // Of the speed along the path.
  [[nodiscard]] virtual LineLimits limits_at(double place) const noexcept = 0;
  [[nodiscard]] virtual int source_at(double place) const noexcept = 0;
  [[nodiscard]] virtual const Pose& end() const noexcept = 0;
  // s at full speed, as for all paths.
  [[nodiscard]] virtual double length() const noexcept = 0;
  // s at the speeds of its commands, without any ramps.
  [[nodiscard]] virtual double at_speed() const noexcept = 0;
  // m
  [[nodiscard]] virtual double way() const noexcept = 0;

 protected:
  ToolPath() = default;
  ToolPath(const ToolPath&) = default;
  ToolPath& operator=(const ToolPath&) = default;

  // How the tool moves and turns at a place in a second at full speed, and the derivatives of that.
  struct Shape {
    Vec3 moving = Vec3::Zero(), turning = Vec3::Zero();
    Vec3 bend = Vec3::Zero(), turn_bend = Vec3::Zero();
    Vec3 twist = Vec3::Zero(), turn_twist = Vec3::Zero();
  };
  // `speed`: what the commands allow.
  static LineLimits limits_for(const Shape& shape, double speed, const ToolLimits& tool) noexcept;
};

}  // namespace indurop::robot
