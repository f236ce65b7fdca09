// SPDX-License-Identifier: Apache-2.0
// The units of one axis: counts of its drive, radians or metres of the arm, degrees or millimetres of its users, who
// may give a position another value.

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "control/robot/kinematics/geometry.h"

namespace indurop::robot {

class AxisUnits {
 public:
  struct Scale {
    double counts = 1;  // per radian or metre; negative: the drive turns the other way
    double gear = 1;
    bool slides = false;  // its users have millimetres, not degrees
    double zero = 0;      // radians or metres, position of the axis while the drive is at count 0
  };
  AxisUnits() = default;
  explicit AxisUnits(const Scale& scale) noexcept : scale_(scale) {}

  // All functions are real-time safe.
  [[nodiscard]] double position(std::int32_t counts) const noexcept { return counts / scale_.counts + scale_.zero; }
  [[nodiscard]] std::int32_t counts(double position) const noexcept {
    constexpr double kMaxCounts = std::numeric_limits<std::int32_t>::max();
    const double wanted = (position - scale_.zero) * scale_.counts * scale_.gear;
    return static_cast<std::int32_t>(std::llround(std::clamp(wanted, -kMaxCounts, kMaxCounts)));
  }
  // Returns the counts per radian or metre, without a sign.
  [[nodiscard]] double resolution() const noexcept { return std::abs(scale_.counts); }
  // Returns the unit of its users.
  [[nodiscard]] double unit() const noexcept { return scale_.slides ? 0.001 : kPi / 180; }
  // Converts a number of its users, as jobs do, to the last bit.
  [[nodiscard]] double from_users(double number) const noexcept {
    return scale_.slides ? number / 1000 : radians(number);
  }
  // Converts a position for users.
  [[nodiscard]] double for_users(double position) const noexcept { return (position - origin_) / unit(); }
  // Return 1 or -1: the sign of the drive's torque relative to the axis, for measured and for commanded values.
  [[nodiscard]] double drive_way() const noexcept { return std::copysign(1, scale_.counts); }
  [[nodiscard]] double command_way() const noexcept { return std::copysign(1, scale_.counts * scale_.gear); }

  // Origin of the positions that users see, from the drive's.
  [[nodiscard]] double origin() const noexcept { return origin_; }
  void set_origin(double origin) noexcept { origin_ = origin; }

 private:
  Scale scale_;
  double origin_ = 0;
};

}  // namespace indurop::robot
