// SPDX-License-Identifier: Apache-2.0
// A motion while it is being planned: what one step of planning hands on to the next.

#pragma once

#include "control/robot/path/segment.h"
#include "control/robot/plan/planning_work.h"

namespace indurop::robot {

struct Draft {
  Segment segment;
  JointLimits joints;  // that this motion keeps: those of the arm, or gentler ones
  ToolLimits tool;
  PlanningWork work;
  bool elbow_given = false;  // the command says where the elbow is at the end
  Wave wave{};               // that the path gets once its places are known
  bool exact = false;        // the path is rejected if it ends elsewhere than at `end`
  Joints end = Joints::Zero();

  // Returns whether the path does not lead to the joints to which it has to.
  [[nodiscard]] bool misses_end() const noexcept {
    constexpr double kSameJoints = 1e-9;  // rad or m
    return exact && (segment.to - end).cwiseAbs().maxCoeff() > kSameJoints;
  }

  // Sets the number of the command that a chain follows at a place, for a fault that is found there.
  void blame(double place) noexcept {
    if (segment.chain != nullptr) {
      segment.source = segment.chain->source_at(place);
    }
  }
};

}  // namespace indurop::robot
