// SPDX-License-Identifier: Apache-2.0
// From a command to a path that is known to work: geometry first, then a check of places along all of it for reach,
// joint limits and singular positions, a few at a time so that planning can be abandoned in between.

#pragma once

#include <array>
#include <cmath>

#include "control/robot/collision/collision_check.h"
#include "control/robot/kinematics/errors.h"
#include "control/robot/path/rates.h"
#include "control/robot/path/segment.h"
#include "control/robot/path/timing_search.h"
#include "control/robot/plan/effort_look.h"
#include "control/robot/plan/rehearsal.h"

namespace indurop::robot {

class Planner {
 public:
  // Work after which no motion is rejected for being slow, nor for torques of its movement: it is planned to its end,
  // however slow it becomes. In places in closed form, of which each takes 15 000 instructions at most.
  static constexpr int kMostWork = 12000;

  Planner(const Places& places, const JointLimits& joints, const ToolLimits& tool);

  // Begins with a motion that starts at `from`. Real-time safe, like all functions of this class, unless collisions
  // have to be checked. Errors: Value, Unreachable, JointLimit, Circle, Workspace.
  Fault begin(const MoveCommand& command, const Joints& from) noexcept;
  // Begins with a path of many pieces that starts where the arm is at `from` and is not changed until the motion has
  // ended; its tool limits already include `acceleration`. Errors: Value.
  Fault begin(const ToolPath& chain, const Joints& from, double acceleration = 1) noexcept;
  // Checks up to `places` more places of it; done() then returns whether that was all. Errors: Unreachable, JointLimit,
  // Singular, Workspace, Collision, Torque.
  Fault check(int places) noexcept;
  [[nodiscard]] bool done() const noexcept { return stage_ == Stage::Done; }
  // Complete when done().
  [[nodiscard]] const Segment& segment() const noexcept { return segment_; }
  // Work done so far, in places: the same on every machine.
  [[nodiscard]] int work() const noexcept { return work_; }

  // The collision check, for replacing its bodies while nothing is being planned.
  [[nodiscard]] CollisionCheck& clear_way() noexcept { return clear_; }

  // The blend of `first` into `second` within first.zone; the zone of the result is 0 if it cannot, or if stopping at
  // the corner is faster.
  [[nodiscard]] Blend blend(const Segment& first, const Segment& second) noexcept;

 private:
  static constexpr int kMost = 256;
  // What a place takes by iteration, in places in closed form: if the pose is reached, and if its orientation is missed
  // on the path. The closest orientation may change as fast as joints near a singular position.
  static constexpr int kStepByStep = 4, kSettlesSlowly = 5;
  static constexpr double kSlowestPace = 0.02;  // part of full speed below which a path counts as singular
  using Samples = std::array<Joints, kMost + 1>;

  // The stages: check reach, limits and singular positions; check collisions; search for a timing; rehearse the result;
  // check torques.
  enum class Stage { Look, Clear, Search, RehearseTiming, RehearseProfile, Effort, Done };

  Fault look(int& places) noexcept;
  Fault time_it() noexcept;
  // Collision check (planner_collisions.cpp).
  Fault begin_clear() noexcept;
  Fault clear(int& places) noexcept;
  bool joints_on_way(double place, const Joints& near, Joints& q) const noexcept;
  [[nodiscard]] bool clear(const Segment& first, const Blend& blend, const Segment& second) noexcept;
  int search() noexcept;  // returns the places that were checked
  void rehearse() noexcept;
  void rehearse_timing() noexcept;
  void rehearse_profile() noexcept;
  void begin_rehearsal(double duration) noexcept;
  // The narrowest places first (planner_narrow.cpp).
  [[nodiscard]] double place_at(double time) const noexcept;
  [[nodiscard]] int instant_of(double place) const noexcept;
  bool begin_stretch(double place, const Joints& there) noexcept;
  void next_stretch(double duration) noexcept;
  void end_rehearsal() noexcept;
  void end_look() noexcept;
  // Minimum duration as limited by the tool, and the planned duration.
  [[nodiscard]] double least() const noexcept;
  [[nodiscard]] double taken() const noexcept;
  [[nodiscard]] bool crawls() const noexcept;
  [[nodiscard]] bool may_refuse() const noexcept { return work_ <= kMostWork; }
  void note_volume(double volume, double place, const Joints& q) noexcept;
  [[nodiscard]] double rehearsal_step() const noexcept;
  Fault resolve(const MoveCommand& command, const Joints& near, Joints& joints, Pose& pose) noexcept;
  Inverse::Result search(const Target& target, const Joints& near) noexcept;
  Fault check_next() noexcept;
  Fault walk(double from, const Joints& start, double to, Joints& q) noexcept;
  [[nodiscard]] Fault check_joint_way() const noexcept;
  Fault look_closer() noexcept;
  [[nodiscard]] double volume(const Joints& q) const noexcept;
  void choose_windows(const Joints* places, const double* volumes, int count, double from, double spacing,
                      int depth) noexcept;
  [[nodiscard]] bool may_leave_range(const Joints* places, int count, int i) const noexcept;
  void note(const Rates& rates) noexcept;
  void bound(const Rates& rates, double from, double length, const Joints& q) noexcept;
  void begin(const Joints& from, double acceleration) noexcept;
  void begin_look(double spacing, int most) noexcept;
  void bound_tool(int place) noexcept;
  Fault make_circle(const Vec3& mid) noexcept;
  void measure_joint_motion(double speed) noexcept;
  void measure_tip() noexcept;
  void measure_tool_motion(const MoveCommand& command) noexcept;

  const Places& places_;
  const JointLimits all_joints_;
  const ToolLimits all_tool_;
  JointLimits joints_;  // of the motion that is being planned
  ToolLimits tool_;
  Segment segment_;
  Samples samples_{};
  std::array<double, kMost + 1> volumes_{};
  WayInside way_;
  CollisionCheck clear_;
  ClearWalk walk_;
  Segment clear_way_;  // joint path that is being checked
  int count_ = 0;      // places after the first
  int next_ = 1;
  int windows_ = 0;
  int noted_ = 0;
  int rehearsals_ = 0;
  int searches_ = 0;
  bool unseen_ = false;  // the last rehearsal did not reach the end
  // Work done so far, in places; with an arm without a closed form one place counts as several. After kMostWork a
  // motion is rejected only for collisions, and for what only the whole rehearsal or check of torques finds in a place.
  int work_ = 0;
  double most_factor_ = 1;  // of the rehearsed motion: one that takes more than this many times as long is rejected
  int weight_ = 1;
  Stage stage_ = Stage::Done;
  // Stretches that are checked more closely before the path is known.
  struct Window {
    double from = 0;
    double length = 0;
    Joints start;
    Joints end;
    int depth = 0;
  };
  static constexpr int kParts = 8;  // per stretch
  std::array<Window, 256> window_{};
  std::array<Rates, std::size_t{3} * kMost> rates_{};
  double wanted_ = 1;  // part of full speed that it would reach without the joints' limits
  PathBounds bounds_;
  TimingSearch search_;
  Rehearsal rehearsal_;
  EffortLook effort_;
  Profile profile_;
  double usual_volume_ = 0;  // maximum volume of this arm
  double least_volume_ = 0;  // on the path
  // Where the path is narrow: at its least volume, and where a joint's limit makes it slowest.
  struct Narrow {
    double place = 0;
    Joints joints = Joints::Zero();
  };
  static constexpr std::size_t kNarrow = 2;
  std::array<Narrow, kNarrow> narrow_;
  double slowest_ = HUGE_VAL;
  std::size_t stretches_ = 0;  // that are still to be rehearsed
};

}  // namespace indurop::robot
