// SPDX-License-Identifier: Apache-2.0
// From a command to a path that is known to work: geometry first, then a check of places along all of it for reach,
// joint limits and singular positions, a few at a time so that planning can be abandoned in between.

#pragma once

#include "control/robot/plan/blending.h"
#include "control/robot/plan/draft.h"
#include "control/robot/plan/effort_look.h"
#include "control/robot/plan/elbow_choice.h"
#include "control/robot/plan/free_search.h"
#include "control/robot/plan/motion_timing.h"
#include "control/robot/plan/path_clearance.h"
#include "control/robot/plan/path_survey.h"
#include "control/robot/plan/wave_check.h"

namespace indurop::robot {

// Leads the motion through the steps of planning; the classes of the steps do the work.
class Planner {
 public:
  Planner(const Places& places, const JointLimits& joints, const ToolLimits& tool);
  Planner(const Planner&) = delete;
  Planner& operator=(const Planner&) = delete;

  // Leaves this part of the joints' limits to others in all motions that are planned from now on.
  void spare(double part) noexcept;
  // Begins with a motion that starts at `from`. Real-time safe, like all functions of this class, unless collisions
  // have to be checked. Errors: Value, Unreachable, JointLimit, Circle, Workspace.
  Fault begin(const MoveCommand& command, const Joints& from) noexcept;
  // Begins with a path of many pieces that starts where the arm is at `from` and is not changed until the motion has
  // ended; its tool limits already include `acceleration`. Errors: Value.
  Fault begin(const ToolPath& chain, const Joints& from, double acceleration = 1, const Wave& wave = {}) noexcept;
  // Begins with a free motion, whose path is searched for and written to `path`, which is not changed afterwards until
  // the motion has ended. Allocates, like check() then. Errors: Value, Unreachable, JointLimit, Collision.
  Fault begin(const MoveCommand& command, JointPath& path, const Joints& from) noexcept;
  // Checks up to `places` more places of it; done() then returns whether that was all. Errors: Unreachable, JointLimit,
  // Singular, Workspace, Collision, Torque, Wave, NoWay.
  Fault check(int places) noexcept;
  [[nodiscard]] bool done() const noexcept { return stage_ == Stage::Done; }
  // Complete when done().
  [[nodiscard]] const Segment& segment() const noexcept { return draft_.segment; }
  // Work done so far, in places: the same on every machine.
  [[nodiscard]] int work() const noexcept { return draft_.work.places(); }

  // The collision check, for replacing its bodies while nothing is being planned.
  [[nodiscard]] CollisionCheck& clear_way() noexcept { return clearance_.bodies(); }

  // The blend of `first` into `second` within first.zone; the zone of the result is 0 if it cannot, or if stopping at
  // the corner is faster.
  [[nodiscard]] Blend blend(const Segment& first, const Segment& second) noexcept {
    return blending_.blend(first, second);
  }

 private:
  // The steps: search for a way; choose where the elbow goes; check reach, limits and singular positions; add a wave;
  // check collisions; find the timing and rehearse it; check torques.
  enum class Stage { Search, Elbow, Survey, Wave, Clearance, Timing, Effort, Done };

  void begin(const Joints& from, double acceleration) noexcept;
  Fault step(int& places) noexcept;
  Fault search(int& places) noexcept;
  void begin_elbow() noexcept;
  void begin_survey() noexcept;
  Fault begin_wave() noexcept;
  Fault begin_clearance() noexcept;
  Fault end_clearance() noexcept;
  Fault begin_timing() noexcept;
  Fault end_timing() noexcept;
  void begin_effort() noexcept;
  [[nodiscard]] Fault check_workspace() const noexcept;

  const Places& places_;
  const JointLimits all_;
  JointLimits joints_;  // the part of them that motions may use
  const ToolLimits tool_;
  Draft draft_;
  ElbowChoice elbow_;
  PathSurvey survey_;
  WaveCheck wave_;
  PathClearance clearance_;
  FreeSearch search_;
  // The free motion that is searched for.
  struct Free {
    MoveCommand command;
    JointPath* path = nullptr;
  };
  Free free_;
  MotionTiming timing_;
  EffortLook effort_;
  Blending blending_;
  Stage stage_ = Stage::Done;
};

}  // namespace indurop::robot
