// SPDX-License-Identifier: Apache-2.0
// Steps through a motion before it begins, from one instant to the next: by how much its joints exceed their shares
// anywhere, whether they could rest before the ends of their ranges, and how much of the remaining limits changes of
// its pace may use.

#pragma once

#include <algorithm>
#include <array>

#include "control/robot/path/pace.h"
#include "control/robot/path/segment.h"

namespace indurop::robot {

class Rehearsal {
 public:
  Rehearsal(const Places& places, const JointLimits& joints) noexcept
      : places_(places), joints_(joints), tip_(places.arm()) {}

  // Begins a motion from rest to rest, with or without a timing. `step`: maximum time from one instant to the next.
  // Real-time safe, like all functions of this class.
  void begin(const Joints& from, double duration, double step, bool timed) noexcept;
  // Checks a stretch of it only: `instants` from `first` on, where the motion is at `place` and the joints at `from`.
  void begin_stretch(const Joints& from, double place, int first, int instants) noexcept;
  [[nodiscard]] bool done() const noexcept { return next_ > end_; }
  [[nodiscard]] int count() const noexcept { return count_; }
  [[nodiscard]] double step() const noexcept { return step_; }
  // The instant that is checked next; look() gets the place of the motion at that time.
  [[nodiscard]] double time() const noexcept;
  [[nodiscard]] bool look(const Segment& segment, double place) noexcept;
  // For a long motion, which is mostly calm: the instant many steps later from which it may continue; below 0: the next
  // instant has to be checked.
  [[nodiscard]] double far_time() const noexcept;
  // Continues from there if joints nearly keep their speeds until then.
  void skip(const Segment& segment, double far_place) noexcept;

  // Factor by which the duration has to grow, at least 1: for the last instant, and, when done, for the whole motion.
  [[nodiscard]] double last_factor() const noexcept;
  [[nodiscard]] double factor() const noexcept;
  // Returns the axis that has to be slower than any other limit requires because it turns back just before the end of
  // its range and could not rest there, from 0; -1: none.
  [[nodiscard]] int restless_axis() const noexcept { return restless_; }
  // Returns whether the last instant is in another posture than the one before it: no slower motion mends that.
  [[nodiscard]] bool jumped() const noexcept;
  // Returns whether a joint steps near the last instant: between places that are as close as numbers can be, it changes
  // by more than its jerk allows between two instants. No slower motion mends that, either. Only worth asking where
  // jerk is worse than it was; adds to `places` how many it needed.
  [[nodiscard]] bool steps(const Segment& segment, int& places) noexcept;
  // m/s, of the tool's tip or the arm's end, whichever is faster.
  [[nodiscard]] double tip_speed() const noexcept { return std::max(tip_.farthest(), tip_far_) / step_; }
  // Limits for changes of the pace at which the motion is followed.
  [[nodiscard]] const PaceLimits& pace_limits() const noexcept { return pace_; }

 private:
  [[nodiscard]] bool calm(const Joints& far) const noexcept;
  void check_rest(const Joints& velocity, const Joints& acceleration) noexcept;
  [[nodiscard]] bool steps_before(std::size_t instant, const Segment& segment, int& places) const noexcept;
  void note(const Joints& first, const Joints& second) noexcept;

  const Places& places_;
  const JointLimits& joints_;
  int count_ = 0;
  int next_ = 0;
  int end_ = 0;
  double step_ = 0;
  double last_ = 0, worst_ = 0;
  double last_jerk_ = 0, suspected_ = 0;  // the part of it that jerk has, and the worst that steps() has checked
  int restless_ = -1;
  double acceleration_share_ = 1, jerk_share_ = 1;
  PaceLimits pace_;
  TipSpeed tip_;
  std::array<Joints, 4> seen_;
  std::array<double, 4> at_{};  // the places where they were seen
  int skip_ = 0;                // instants to skip next time
  int wait_ = 0;                // instants to check before that
  int unknown_ = 0;             // instants after skipped ones whose differences are not known
  double tip_far_ = 0;          // m that the tip or the arm's end moves at most in one skipped step
};

}  // namespace indurop::robot
