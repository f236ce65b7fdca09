// SPDX-License-Identifier: Apache-2.0
// From a command to a path that is known to work: geometry first, then a look at places all along it for reach, joint
// limits and singular positions, a few at a time so that it can be given up in between.

#pragma once

#include <array>

#include "robot/clear_way.h"
#include "robot/effort_look.h"
#include "robot/errors.h"
#include "robot/path_rates.h"
#include "robot/rehearsal.h"
#include "robot/segment.h"
#include "robot/timing_search.h"

namespace indurop::robot {

class Planner {
 public:
  // Places that are looked at until a motion is refused: 50 ms of an ordinary processor.
  static constexpr int kMostWork = 16000;

  Planner(const Places& places, const JointLimits& joints, const ToolLimits& tool);

  // Begins with a motion that starts at `from`. Real-time safe, as all here, unless something could be touched. Errors:
  // Value, Unreachable, JointLimit, Circle, Workspace.
  Fault begin(const MoveCommand& command, const Joints& from) noexcept;
  // Begins with a way of many pieces that starts where the arm is at `from` and stays as it is until the motion has
  // ended; its tool limits are those of `acceleration` already. Errors: Value.
  Fault begin(const ToolPath& chain, const Joints& from, double acceleration = 1) noexcept;
  // Looks at up to `places` more places of it; done() then says whether that was all. Errors: Unreachable, JointLimit,
  // Singular, Workspace, Collision, Torque.
  Fault check(int places) noexcept;
  [[nodiscard]] bool done() const noexcept { return stage_ == Stage::Done; }
  // Complete when done().
  [[nodiscard]] const Segment& segment() const noexcept { return segment_; }
  // How much work that was, in places: the same on every machine.
  [[nodiscard]] int work() const noexcept { return work_; }

  // For other bodies. Nothing is being planned.
  [[nodiscard]] ClearWay& clear_way() noexcept { return clear_; }

  // How `first` goes over into `second` with first.zone; zone 0 in the result if it cannot, or if
  // stopping at the corner is faster.
  [[nodiscard]] Blend blend(const Segment& first, const Segment& second) noexcept;

 private:
  static constexpr int kMost = 256;
  static constexpr double kSlowestPace = 0.02;  // part of full speed below which a path counts as singular
  using Samples = std::array<Joints, kMost + 1>;

  // Looking for reach, limits and singular positions; for what would be touched; then for a timing; then going through
  // what came out; then for torques.
  enum class Stage { Look, Clear, Search, RehearseTiming, RehearseProfile, Effort, Done };

  Fault look(int& places) noexcept;
  void time_it() noexcept;
  // What would be touched (planner_clear.cpp).
  void begin_clear() noexcept;
  Fault clear(int& places) noexcept;
  bool joints_on_way(double place, const Joints& near, Joints& q) const noexcept;
  [[nodiscard]] bool clear(const Segment& first, const Blend& blend, const Segment& second) noexcept;
  int search() noexcept;  // returns the places that were looked at
  void rehearse() noexcept;
  void rehearse_timing() noexcept;
  void rehearse_profile() noexcept;
  void begin_rehearsal(double duration) noexcept;
  void end_rehearsal() noexcept;
  void end_look() noexcept;
  // How long it takes at least, by the tool, and as it is planned.
  [[nodiscard]] double least() const noexcept;
  [[nodiscard]] double taken() const noexcept;
  [[nodiscard]] bool crawls() const noexcept;
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
  void note(const Rates& rates) noexcept;
  void bound(const Rates& rates, double from, double length) noexcept;
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
  JointLimits joints_;  // of the motion that is planned
  ToolLimits tool_;
  Segment segment_;
  Samples samples_{};
  std::array<double, kMost + 1> volumes_{};
  WayInside way_;
  ClearWay clear_;
  ClearWalk walk_;
  Segment clear_way_;  // of joints, that is looked at
  int count_ = 0;      // places after the first
  int next_ = 1;
  int windows_ = 0;
  int noted_ = 0;
  int rehearsals_ = 0;
  int searches_ = 0;
  bool unseen_ = false;  // the last rehearsal did not come to an end
  // What was done for it, in places; one of an arm without a closed form is some. It is refused before kMostWork or not
  // at all, but for what would touch and for torques, which are always looked at.
  int work_ = 0;
  double most_factor_ = 1;  // of what is rehearsed: what takes so many times as long is refused
  int weight_ = 1;
  Stage stage_ = Stage::Done;
  // Stretches that are looked at closer before the path is known.
  struct Window {
    double from = 0;
    double length = 0;
    Joints start;
    Joints end;
    int depth = 0;
  };
  static constexpr int kParts = 8;  // of a stretch
  std::array<Window, 256> window_{};
  std::array<Rates, std::size_t{3} * kMost> rates_{};
  double wanted_ = 1;  // part of full speed that it would come to, before the joints were asked
  PathBounds bounds_;
  TimingSearch search_;
  Rehearsal rehearsal_;
  EffortLook effort_;
  Profile profile_;
  double usual_volume_ = 0;  // of this arm, at most
  double least_volume_ = 0;  // on the path
};

}  // namespace indurop::robot
