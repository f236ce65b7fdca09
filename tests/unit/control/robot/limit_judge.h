// SPDX-License-Identifier: Apache-2.0
// Checks every set point of an arm's drives, as differences between periods, against the limits of the joints.

#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "group_cell.h"

namespace indurop::robot {

inline constexpr double kEmergency = 1.5;  // Settings::emergency_factor

// Differences between set points of drives that follow them, each against its limit.
class Judge {
 public:
  // Of the cell's arm, or of that of another URDF file.
  // `rounding`: what set points may be off by, rad or m; of paths of the tool near singular positions, if not said.
  explicit Judge(double period, const std::string& urdf = cell_urdf(), double rounding = 5e-11)
      : period_(period),
        rounding_(rounding),
        model_(arm_from_urdf("robot.urdf", urdf).value()),
        limits_(limits_of(model_, Settings{})) {}

  // Empty, or what is broken.
  std::string look(const Cell& cell, double hardness) { return look(cell, hardness, hardness * hardness); }
  // Parts of the limits of acceleration and jerk.
  std::string look(const Cell& cell, double hardness, double jerk_part) {
    std::string broken;
    for (std::size_t i = 0; i < static_cast<std::size_t>(model_.arm.count()); ++i) {
      Seen& seen = seen_[i];
      const Axis& axis = model_.arm.axis(static_cast<int>(i));
      const double p = cell.out.command[i] * (axis.slides() ? 0.001 : kPi / 180);
      if (cell.in.drives[i].status != 0x27 || cell.in.drives[i].mode != 8) {
        seen = {p, 0, 0};
        continue;
      }
      const auto k = static_cast<Eigen::Index>(i);
      const double v = (p - seen.p) / period_;
      const double a = (v - seen.v) / period_;
      const double j = (a - seen.a) / period_;
      const double beyond = std::max(axis.lower - p, p - axis.upper);
      if (!axis.endless && !(beyond <= 1e-6)) {
        broken += fmt::format("axis {} is {} rad beyond its range; ", i + 1, beyond);
      }
      judge(broken, i, "speed", v / limits_.velocity[k]);
      judge(broken, i, "acceleration", a / limits_.acceleration[k] / hardness);
      // A third difference is off by eight times as much as what each set point is rounded by.
      const double rounding = 8 * rounding_ / (period_ * period_ * period_);
      judge(broken, i, "jerk", std::max(0.0, std::abs(j) - rounding) / limits_.jerk[k] / jerk_part);
      seen = {p, v, a};
    }
    return broken;
  }

 private:
  struct Seen {
    double p = 0, v = 0, a = 0;
  };
  static void judge(std::string& broken, std::size_t axis, const char* what, double part) {
    if (!(std::abs(part) <= 1.001)) {
      broken += fmt::format("axis {}: {} {:.3f} times its limit; ", axis + 1, what, part);
    }
  }

  static JointLimits limits_of(const ArmModel& model, const Settings& settings) {
    const Joints acceleration = model.velocity / settings.time_to_speed;
    return {model.velocity, acceleration, acceleration / settings.time_to_acceleration};
  }

  double period_;
  double rounding_;
  ArmModel model_;
  JointLimits limits_;
  std::array<Seen, kJoints> seen_{};
};

}  // namespace indurop::robot
