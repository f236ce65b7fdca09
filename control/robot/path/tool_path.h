// SPDX-License-Identifier: Apache-2.0
// A path of the tool that consists of many pieces, as the planner sees it: the tool's pose at each place, and the speed
// that it and the commands allow there. Places are seconds at full speed.

#pragma once

#include "control/robot/kinematics/geometry.h"
#include "control/robot/path/profile.h"
#include "control/robot/path/wave.h"

namespace indurop::robot {

// Limits of the tool's motion.
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

  // Movement and rotation of the tool at a place, per second at full speed, and their derivatives.
  struct Shape {
    Vec3 moving = Vec3::Zero(), turning = Vec3::Zero();
    Vec3 bend = Vec3::Zero(), turn_bend = Vec3::Zero();
    Vec3 twist = Vec3::Zero(), turn_twist = Vec3::Zero();
    double speed = 1;  // along the path, that the commands allow
  };

  // Real-time safe, like all functions of this class.
  [[nodiscard]] virtual Pose pose_at(double place) const noexcept = 0;
  [[nodiscard]] virtual Shape shape_at(double place) const noexcept = 0;
  // Distances are those along its pieces.
  [[nodiscard]] virtual PathWay way_at(double place) const noexcept {
    return {place / length() * way(), way(), shape_at(place).moving};
  }
  // Limits of the speed along the path, with fixed shares for bends and for changes of the speed.
  [[nodiscard]] LineLimits limits_at(double place) const noexcept;
  [[nodiscard]] const ToolLimits& tool() const noexcept { return tool_; }
  [[nodiscard]] virtual int source_at(double place) const noexcept = 0;
  [[nodiscard]] virtual const Pose& end() const noexcept = 0;
  // s at full speed, as for all paths.
  [[nodiscard]] virtual double length() const noexcept = 0;
  // s at the speeds of its commands, without ramps.
  [[nodiscard]] virtual double at_speed() const noexcept = 0;
  // Length in m.
  [[nodiscard]] virtual double way() const noexcept = 0;

 protected:
  ToolPath() = default;
  ToolPath(const ToolPath&) = default;
  ToolPath& operator=(const ToolPath&) = default;

  ToolLimits tool_;
};

}  // namespace indurop::robot
