// SPDX-License-Identifier: Apache-2.0
// How fast a path is followed: searches for its timing, rehearses the motion, and slows it down until it keeps the
// limits of the joints.

#pragma once

#include "control/robot/path/timing_search.h"
#include "control/robot/plan/motion_rehearsal.h"

namespace indurop::robot {

class MotionTiming {
 public:
  MotionTiming(const Places& places, Draft& draft, const PathFindings& findings) noexcept
      : draft_(draft), findings_(findings), search_(places, draft.joints), rehearsal_(places, draft, findings) {}

  // Begins with the draft's path. `wanted`: part of full speed that it would reach without the joints' limits.
  // Real-time safe, like all functions of this class.
  void begin(double wanted) noexcept;
  // Does a part of the work and subtracts from `places` how much that was.
  void work(int& places) noexcept;
  // Then the draft's segment is complete, or has to be rejected.
  [[nodiscard]] bool done() const noexcept { return stage_ == Stage::Done; }
  // Why the motion cannot be followed, or takes unacceptably longer than the tool's speed would allow: Singular, or
  // JointLimit if an axis could not rest before the end of its range.
  [[nodiscard]] Fault fault() const noexcept;

 private:
  enum class Stage { Search, RehearseTiming, RehearseProfile, Done };

  [[nodiscard]] int search() noexcept;
  [[nodiscard]] bool may_search_again() const noexcept;
  void rehearse() noexcept;
  void rehearse_timing() noexcept;
  void rehearse_profile() noexcept;
  [[nodiscard]] bool begin_rehearsal(double duration) noexcept;
  [[nodiscard]] bool is_too_slow(double duration) const noexcept;
  void end_rehearsal() noexcept;
  void end_profile(double slower, bool sure) noexcept;
  void end_timing(double slower, bool sure) noexcept;
  [[nodiscard]] bool begins_narrow() const noexcept { return searches_ == 1 && rehearsals_ == 0; }
  [[nodiscard]] Profile profile() const noexcept;
  [[nodiscard]] double least() const noexcept;
  [[nodiscard]] bool crawls() const noexcept;

  Draft& draft_;
  const PathFindings& findings_;
  TimingSearch search_;
  MotionRehearsal rehearsal_;
  Stage stage_ = Stage::Done;
  int before_search_ = 0;  // work
  int searches_ = 1;
  int rehearsals_ = 0;
  double most_factor_ = 1;  // of the rehearsed motion: one that takes more than this many times as long is rejected
  bool unseen_ = false;     // the last rehearsal did not reach the end
};

}  // namespace indurop::robot
