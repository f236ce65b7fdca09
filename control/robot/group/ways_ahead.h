// SPDX-License-Identifier: Apache-2.0
// What the group reports of the motions that are planned: where the tool will go. The planning thread writes the ways;
// here is the memory for them. All functions are real-time safe.

#pragma once

#include <array>
#include <span>

#include "control/robot/group/robot.h"
#include "control/robot/plan/planning_desk.h"

namespace indurop::robot {

class WaysAhead {
 public:
  explicit WaysAhead(const Robot& robot) noexcept : robot_(robot) {}

  // The paths of jobs that were interrupted, whose ways are not used for anything else meanwhile.
  void set_left(std::span<const KeptPath> left) noexcept { left_ = left; }
  // Memory for the way of a motion that is about to be planned, other than `taken`; null: there is none.
  [[nodiscard]] ToolWay* for_plan(const PlanningDesk& desk, const ToolWay* taken = nullptr) noexcept;
  // `known`: the arm follows its path where that was planned.
  void report(bool known, Outputs& out) noexcept;

 private:
  const Robot& robot_;
  std::span<const KeptPath> left_;
  std::uint32_t made_ = 0;
  std::array<std::uint32_t, kWaysAhead> reported_{};  // ToolWay::number; 0: none
  // Of all paths (followed, kept, interrupted), two requests, and one more each.
  std::array<ToolWay, (2 + kMaxPriorities) * PathPieces::kMaxSegments + 6> ways_{};
};

}  // namespace indurop::robot
