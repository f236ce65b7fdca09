// SPDX-License-Identifier: Apache-2.0
// A motion that is given by a table of times: position, velocity or acceleration of an axis at each of them. It begins
// with the state of the axis, and has no jumps of speed and acceleration.

#pragma once

#include <indurop/robot/commands.h>

#include "control/robot/path/profile.h"

namespace indurop::robot {

class TimeProfile {
 public:
  enum class Of { Position, Velocity, Acceleration };
  // Converts the numbers of the table: values * scale + offset, times * time_scale.
  struct Scale {
    double time = 1;
    double value = 1;
    double offset = 0;
  };
  // Sets the table, beginning with `start` at time 0. Positions: a spline through all of them, at rest at the end.
  // Velocities: a curve that never exceeds two neighbouring values, without acceleration at the end. Accelerations:
  // linear between neighbours. Errors: Value (no points, not numbers, times that do not rise from above 0); the profile
  // is then unchanged. Real-time safe, like all functions of this class.
  ErrorCode set(const ProfileTable& table, Of of, const Scale& scale, const LineState& start) noexcept;

  [[nodiscard]] double duration() const noexcept { return duration_; }
  // State at `time`; after its end it moves on with its last velocity.
  [[nodiscard]] LineState at(double time) const noexcept;

  // The exact minimum and maximum of a quantity over the whole motion.
  struct Range {
    double least = 0;
    double greatest = 0;
    [[nodiscard]] double peak() const noexcept;
  };
  struct Ranges {
    Range position, velocity, acceleration, jerk;
  };
  [[nodiscard]] Ranges ranges() const noexcept;

 private:
  static constexpr std::size_t kDegree = 5;
  using Polynomial = std::array<double, kDegree + 1>;  // position as a function of the time since the segment began
  struct Segment {
    double begin = 0;
    double duration = 0;
    Polynomial way{};
  };
  struct Points;
  void through_positions(const Points& points, const LineState& start) noexcept;
  void through_velocities(const Points& points, const LineState& start) noexcept;
  void through_accelerations(const Points& points, const LineState& start) noexcept;

  std::array<Segment, kProfilePoints> segments_{};
  std::size_t count_ = 0;
  double duration_ = 0;
};

}  // namespace indurop::robot
