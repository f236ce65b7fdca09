// SPDX-License-Identifier: Apache-2.0
// From a request to a plan. Lines with zones are planned as one chain, and one by one too as far as that is needed to
// know which takes less time; other motions with a zone together with the motion after them. So a zone never makes a
// motion slower than a stop there.

#pragma once

#include <atomic>

#include "control/robot/path/chain.h"
#include "control/robot/plan/path_sweep.h"
#include "control/robot/plan/planner.h"
#include "control/robot/plan/way_ahead.h"

namespace indurop::robot {

struct PlanRequest {
  MoveCommand command;              // with `lines`: the first one, without its zone
  const ToolPath* chain = nullptr;  // instead of `command`; is not changed until the motion has ended
  Joints from = Joints::Zero();
  bool follows = false;          // continues the motion that was planned before, without a stop
  const Chain* lines = nullptr;  // the chain, if its lines may also be followed one by one
  bool leads = false;            // `then` is known: it follows, and is no chain
  MoveCommand then{};
  double reserve = 0;               // part of the joints' limits that is left to a correction of the path
  JointPath* joint_path = nullptr;  // of a free motion: receives its path; is not used until the motion has ended
  bool unreserved = false;          // the motion is not granted as a whole, but step by step while it is executed
  SpaceCells* cells = nullptr;      // receives the cells through which it leads; null: they are not needed
  // Receive the way of the tool, and that of the motion before up to a blend into this one; null: they are not needed.
  ToolWay* way = nullptr;
  ToolWay* cut = nullptr;
};

struct Plan {
  Fault fault;
  Segment segment;               // if planning failed only its source is valid
  Blend blend;                   // from the motion before into this one
  const ToolWay* cut = nullptr;  // replaces the way of the motion before; null: it remains
  bool parts = false;            // the lines of the chain are followed one by one; this is the first one
};

class MotionPlanning {
 public:
  // `grid`: as for PathSweep.
  MotionPlanning(const Places& places, const JointLimits& joints, const ToolLimits& tool, const CellGrid* grid)
      : joints_(joints), planner_(places, joints, tool), sweep_(places, joints_, grid), way_(places, joints_) {}

  [[nodiscard]] Planner& planner() noexcept { return planner_; }
  // Makes the plan; `dropped` abandons it. Real-time safe unless collisions have to be checked.
  void plan(const PlanRequest& request, const std::atomic<bool>& dropped, Plan& plan) noexcept;

 private:
  void sample_way(const PlanRequest& request, Plan& plan) noexcept;
  void plan_one(const PlanRequest& request, const std::atomic<bool>& dropped, Plan& plan) noexcept;
  // Plans the same motion with its zone. Returns whether it is faster that way; `stopping` is the motion without.
  [[nodiscard]] bool zone_helps(const PlanRequest& request, const std::atomic<bool>& dropped, const Segment& stopping,
                                Segment& rounding) noexcept;
  [[nodiscard]] double from_rest(const Segment& segment) const noexcept;
  Fault finish(Fault fault, const std::atomic<bool>& dropped) noexcept;
  // Returns whether the lines of the chain that was planned are followed one by one.
  [[nodiscard]] bool parts(const Chain& lines, const PlanRequest& request, const std::atomic<bool>& dropped,
                           const Plan& joined) noexcept;

  const JointLimits joints_;
  Planner planner_;
  Segment before_;
  PathSweep sweep_;
  WayAhead way_;
};

}  // namespace indurop::robot
