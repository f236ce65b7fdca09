// SPDX-License-Identifier: Apache-2.0
// A motion that is given by a table of times: where, how fast or how hard an axis is at each of them. It begins as the
// axis is, and has no jumps of speed and acceleration.

#pragma once

#include <indurop/robot/commands.h>

#include "robot/profile.h"

namespace indurop::robot {

class TimeProfile {
 public:
  enum class Of { Position, Velocity, Acceleration };
  // What the numbers of the table stand for: values * scale + offset, times * time_scale.
  struct Scale {
    double time = 1;
    double value = 1;
    double offset = 0;
  };
  // From `start` on, which counts at time 0. Positions: a spline through all of them, at rest at the end. Velocities: a
  // curve that is nowhere beyond two neighbours, without acceleration at the end. Accelerations: straight from one to
  // the next. Errors: Value (no points, not numbers, times that do not rise from above 0), and it is as before.
  // Real-time safe, as all here.
  ErrorCode set(const ProfileTable& table, Of of, const Scale& scale, const LineState& start) noexcept;

  [[nodiscard]] double duration() const noexcept { return duration_; }
  // Beyond its end it moves on with its last velocity.
  [[nodiscard]] LineState at(double time) const noexcept;

  // The least and the greatest of it on all of its way, exactly.
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
  using Polynomial = std::array<double, kDegree + 1>;  // position, by the time since the segment began
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
