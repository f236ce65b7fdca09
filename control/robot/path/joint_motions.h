// SPDX-License-Identifier: Apache-2.0
// Joint motions whose axes arrive together, from rest or from any motion of the joints: their timing for a pace, the
// limit of the tip's speed on them, and the checks that the planner could not make. Real-time safe.

#pragma once

#include <cmath>

#include "control/robot/collision/collision_check.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

class JointMotions {
 public:
  // The places are borrowed.
  JointMotions(const Places& places, const JointLimits& limits) noexcept
      : places_(places), limits_(limits), collisions_(places.clearance(), false) {}

  [[nodiscard]] const JointLimits& limits() const noexcept { return limits_; }
  // Gives access to the collision check to exchange its bodies.
  [[nodiscard]] CollisionCheck& collisions() noexcept { return collisions_; }
  // Speed limit of the tool's tip and of the arm's end, in m/s; HUGE_VAL: no such limit.
  void set_tip_limit(double speed) noexcept { tip_limit_ = speed; }
  // Returns the pace at which a tip of this speed keeps its limit.
  [[nodiscard]] double pace_for(double tip_speed) const noexcept {
    return tip_speed > tip_limit_ ? tip_limit_ / tip_speed : 1;
  }
  // Returns the tip speed of a joint motion, as far as samples along it show.
  [[nodiscard]] double tip_speed_of(const Segment& segment) const noexcept;
  // Returns the pace for which a motion from rest is timed if this pace is wanted.
  [[nodiscard]] double made_for(double pace) const noexcept;

  // Makes the timing of a motion from rest, for a pace or a slower one at which the tip keeps its limit.
  void time(Segment& segment, double pace) const noexcept;
  // A motion of the joints to continue from.
  struct Beginning {
    JointState now;
    bool moving = false;
    bool exact = true;  // its acceleration is known exactly
  };
  // Makes the timing of a motion that begins there, for the requested pace, as far as the present motion of the joints
  // can be part of it at that pace. Errors: JointLimit, Workspace, Speed, Collision.
  Fault begin(Segment& segment, const Beginning& from, double pace) noexcept;
  // Changes from full limits to a timing that leaves a margin for changes of the pace, from this place on. Returns
  // false where a joint could then not come to rest before its target: the motion continues to its end, which takes no
  // longer than braking.
  bool leave_margin(Segment& segment, double place) noexcept;

 private:
  // A motion that begins in motion keeps its pace.
  void time(Segment& segment, const JointState& from, const JointLimits& limits, double pace) const noexcept;
  [[nodiscard]] bool can_begin(const JointState& now, double pace, const JointLimits& limits) const noexcept;
  [[nodiscard]] Fault check_collisions(const Segment& segment) noexcept;

  const Places& places_;
  JointLimits limits_;
  CollisionCheck collisions_;
  double tip_limit_ = HUGE_VAL;
};

}  // namespace indurop::robot
