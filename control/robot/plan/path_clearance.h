// SPDX-License-Identifier: Apache-2.0
// Checks that a motion stays clear of the arm itself, of the tool and of zones, all along its path.

#pragma once

#include "control/robot/collision/collision_check.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/plan/path_survey.h"

namespace indurop::robot {

class PathClearance {
 public:
  // `joints`: the arm's own limits. `survey`: knows joint angles on paths of the tool.
  PathClearance(const Places& places, const JointLimits& joints, Draft& draft, const PathSurvey& survey)
      : places_(places), joints_(joints), draft_(draft), survey_(survey), bodies_(places.clearance(), true) {}

  // Begins with the draft's path. If it is done() then, there is nothing to check. Real-time safe, like all functions
  // of this class, unless collisions have to be checked.
  void begin() noexcept;
  // Checks up to `places` more places and subtracts those it checked. Errors: Singular, Collision.
  Fault check(int& places) noexcept;
  [[nodiscard]] bool done() const noexcept { return walk_.done(); }
  // Returns whether a whole blend is clear.
  [[nodiscard]] bool is_clear(const Segment& first, const Blend& blend, const Segment& second) noexcept;
  // The collision check, for replacing its bodies while nothing is being planned.
  [[nodiscard]] CollisionCheck& bodies() noexcept { return bodies_; }

 private:
  bool joints_at(double place, const Joints& near, Joints& q) const noexcept;

  const Places& places_;
  const JointLimits& joints_;
  Draft& draft_;
  const PathSurvey& survey_;
  CollisionCheck bodies_;
  ClearWalk walk_;
  Segment path_;  // of joints, that is being checked
};

}  // namespace indurop::robot
