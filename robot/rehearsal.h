// SPDX-License-Identifier: Apache-2.0
// A motion is gone through before it begins, from one instant to the next: how far its joints go beyond their shares
// anywhere, and what changes of its pace may take of what is left.

#pragma once

#include <algorithm>
#include <array>

#include "robot/pace.h"
#include "robot/segment.h"

namespace indurop::robot {

class Rehearsal {
 public:
  Rehearsal(const Places& places, const JointLimits& joints) noexcept
      : places_(places), joints_(joints), tip_(places.arm()) {}

  // A motion from rest to rest, with or without a timing. `step`: from one instant to the next, at most. Real-time
  // safe, as all here.
  void begin(const Joints& from, double duration, double step, bool timed) noexcept;
  [[nodiscard]] bool done() const noexcept { return next_ > count_ + 3; }
  // The instant that is looked at next, and where the motion is then.
  [[nodiscard]] double time() const noexcept;
  [[nodiscard]] bool look(const Segment& segment, double place) noexcept;
  // Of a long motion, which is mostly calm: the instant that it may go on from, behind many others; below 0: the next
  // one has to be looked at.
  [[nodiscard]] double far_time() const noexcept;
  // Goes on from there if joints keep about their speeds until then.
  void skip(const Segment& segment, double far_place) noexcept;

  // How many times as long it has to take, 1 at least: by the last instant, and, when done, as a whole.
  [[nodiscard]] double last_factor() const noexcept;
  [[nodiscard]] double factor() const noexcept;
  // m/s, of the tool's tip or the arm's end.
  [[nodiscard]] double tip_speed() const noexcept { return std::max(tip_.farthest(), tip_far_) / step_; }
  // Of changes of the pace at which it is followed.
  [[nodiscard]] const PaceLimits& pace_limits() const noexcept { return pace_; }

 private:
  [[nodiscard]] bool calm(const Joints& far) const noexcept;
  void note(const Joints& first, const Joints& second) noexcept;

  const Places& places_;
  const JointLimits& joints_;
  int count_ = 0;
  int next_ = 0;
  double step_ = 0;
  double last_ = 0, worst_ = 0;
  double acceleration_share_ = 1, jerk_share_ = 1;
  PaceLimits pace_;
  TipSpeed tip_;
  std::array<Joints, 4> seen_;
  int skip_ = 0;        // so many instants, next time
  int wait_ = 0;        // so many are looked at before
  int unknown_ = 0;     // so many whose differences are not known, behind skipped ones
  double tip_far_ = 0;  // m that the tip or the arm's end goes at most in a step of skipped ones
};

}  // namespace indurop::robot
