// SPDX-License-Identifier: Apache-2.0
// Ends and limits of one axis, and those of its motions as a single axis: programs write them as parameters, never
// beyond those of the axis.

#pragma once

#include <indurop/robot/controller.h>

#include "control/robot/axis/motion.h"
#include "control/robot/axis/units.h"
#include "control/robot/kinematics/arm.h"
#include "control/robot/path/profile.h"

namespace indurop::robot {

class AxisBounds {
 public:
  // Limits of its own motions; the ends apply only if they are enabled.
  struct Own {
    double lower = 0, upper = 0;
    bool lower_counts = true, upper_counts = true;
    double velocity = 0, acceleration = 0, deceleration = 0, jerk = 0;
  };
  AxisBounds() = default;
  AxisBounds(const Axis& axis, const LineLimits& limits) noexcept;

  // Sets the factors on accelerations and jerks of motions that begin. Real-time safe, like all functions of this
  // class.
  void set_factors(double acceleration, double jerk) noexcept;
  // Limits the motion to these bounds.
  void apply_to(AxisMotion& motion) const noexcept;

  // Whether its ends may change: only while the axis rests between them, so that no motion is on its way to a position
  // beyond the new ones.
  struct Present {
    bool rests = false;
    double position = 0;
  };
  // Writes a parameter. Limits apply to motions that begin. Errors: Value (a read-only parameter or an impossible
  // value), State, JointLimit.
  ErrorCode change(int parameter, double value, const AxisUnits& units, const Present& now) noexcept;

  [[nodiscard]] const Own& own() const noexcept { return own_; }
  [[nodiscard]] const LineLimits& most() const noexcept { return most_; }
  // Returns the limits of the axis for braking with this hardness.
  [[nodiscard]] LineLimits limits(double hardness) const noexcept {
    return {most_.velocity, most_.acceleration * hardness, most_.jerk * hardness * hardness};
  }
  [[nodiscard]] double acceleration_factor() const noexcept { return acceleration_factor_; }
  [[nodiscard]] double jerk_factor() const noexcept { return jerk_factor_; }
  // Returns whether it turns endlessly: a position in another turn is the same place.
  [[nodiscard]] bool endless() const noexcept { return endless_; }
  // Returns whether both positions are between the ends.
  [[nodiscard]] bool inside(double one, double other) const noexcept;
  // A motion without a target rests at a distance from the ends: these return whether a position is beyond that.
  [[nodiscard]] bool beyond_upper(double position) const noexcept { return position > upper_ - kEndMargin; }
  [[nodiscard]] bool beyond_lower(double position) const noexcept { return position < lower_ + kEndMargin; }
  [[nodiscard]] bool clear(double position) const noexcept {
    return position >= lower_ + kEndMargin && position <= upper_ - kEndMargin;
  }
  void report(const AxisUnits& units, AxisReport& report) const noexcept;

 private:
  static constexpr double kEndMargin = radians(0.1);

  ErrorCode change_ends(const Own& own, const Present& now) noexcept;
  void keep_ends() noexcept;

  Own own_;
  double least_ = 0, greatest_ = 0;  // ends of the axis
  double lower_ = 0, upper_ = 0;     // its own ends where they are enabled, else those of the axis
  bool endless_ = false;
  LineLimits most_;
  double acceleration_factor_ = 1, jerk_factor_ = 1;
};

}  // namespace indurop::robot
