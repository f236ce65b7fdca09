// SPDX-License-Identifier: Apache-2.0
// How a single axis follows others, or adds a superimposed motion to its own: the laws in force, its leaders, and the
// way back to its own motion.

#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "control/robot/axis/coupling.h"
#include "control/robot/axis/motion.h"
#include "control/robot/axis/neighbours.h"

namespace indurop::robot {

// An axis that another one follows as a single axis, from 0, and the factor on its motion.
struct AxisLeader {
  int axis = 0;
  double ratio = 1;
};

// How an axis is about to follow.
struct AxisFollow {
  CouplingLaw law;
  std::array<AxisLeader, 2> leaders;
  std::size_t leading = 1;  // 0: it follows the tool
};

class AxisFollowing {
 public:
  // Follows from the next period on. Real-time safe, like all functions of this class.
  void engage(const AxisFollow& way, const LineLimits& limits, const LineLimits& most, const LineState& now) noexcept;
  // Adds a distance to the motion that is in progress.
  void superimpose(double distance, const LineLimits& limits, const LineLimits& most, const LineState& now) noexcept;
  void stop_superimposed(const LineLimits& limits) noexcept { coupling_.stop_shift(limits); }
  // The superimposed motion has ended.
  void end_superimposed() noexcept { over_ = false; }
  void shift_master(double to, const LineLimits& limits) noexcept { coupling_.shift_master(to, limits); }
  // Gives the motion back: it begins once the axis has no acceleration.
  void release(AxisMotion& motion) noexcept;
  // The axis is somewhere else: it follows nothing.
  void drop() noexcept { coupled_ = over_ = leaving_ = false; }
  void hold(bool held) noexcept { coupling_.hold(held); }

  // Computes the next set point from those of the leaders. Errors: Master (one of them may not lead any more), and
  // those of AxisCoupling::step().
  ErrorCode step(const AxisNeighbours& row, double seconds) noexcept;
  // Adds to the axis' own motion, which has already advanced by this period.
  ErrorCode step_over(const LineState& own, const SetPointGate& gate, double seconds) noexcept;
  // Called while leaving().
  void step_leaving(const SetPointGate& gate, double seconds) noexcept { leaving_ = !coupling_.leave(gate, seconds); }

  [[nodiscard]] bool coupled() const noexcept { return coupled_; }
  // Returns whether a superimposed motion is on the axis' own motion.
  [[nodiscard]] bool over() const noexcept { return over_; }
  [[nodiscard]] bool leaving() const noexcept { return leaving_; }
  // Returns whether the gate has to bring the axis to rest.
  [[nodiscard]] bool brakes() const noexcept { return leaving_ && coupling_.brakes(); }
  [[nodiscard]] bool synced() const noexcept { return coupling_.synced(); }
  [[nodiscard]] double phase() const noexcept { return coupling_.phase(); }
  [[nodiscard]] const LineState& state() const noexcept { return coupling_.state(); }
  // Empty for an axis that follows the tool.
  [[nodiscard]] std::span<const AxisLeader> leaders() const noexcept {
    return {leaders_.data(), coupled_ ? leading_ : 0};
  }

 private:
  AxisCoupling coupling_;
  bool coupled_ = false;
  bool over_ = false;
  bool leaving_ = false;
  std::array<AxisLeader, 2> leaders_;
  std::size_t leading_ = 1;  // number of leaders
};

}  // namespace indurop::robot
