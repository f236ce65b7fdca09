// SPDX-License-Identifier: Apache-2.0
// Rehearses a motion: long ones first where their path is narrow and then as a whole, so that what has to be rejected
// is rejected early.

#pragma once

#include <cstddef>

#include "control/robot/plan/path_findings.h"
#include "control/robot/plan/rehearsal.h"

namespace indurop::robot {

class MotionRehearsal {
 public:
  MotionRehearsal(const Places& places, Draft& draft, const PathFindings& findings) noexcept
      : places_(places), draft_(draft), findings_(findings), rehearsal_(places, draft.joints) {}

  // Returns whether instants have to be close to each other: for chains, whose corners may be narrow, in waves, near
  // singular positions, where an axis turns back near the end of its range, and where an orientation is missed.
  // Real-time safe, like all functions of this class.
  [[nodiscard]] bool is_fine() const noexcept;
  // Begins with the draft's path, followed by its timing. `narrow_first`: a long motion begins where it is narrow.
  void begin_timing(bool narrow_first) noexcept;
  // The same, followed by a profile.
  void begin_profile(const Profile& profile, bool narrow_first) noexcept;
  // Checks the next instant. Returns whether the arm reaches its place there.
  [[nodiscard]] bool check_next() noexcept;
  // Returns whether a joint steps there, which no slower motion mends.
  [[nodiscard]] bool steps() noexcept;
  // Instants in which a motion of `duration` s is checked.
  [[nodiscard]] double instants(double duration) const noexcept { return duration / step(); }
  // Continues with the next narrow place or, after all of them, the whole motion, if the present one is at its end.
  // Returns false if that was the whole motion.
  [[nodiscard]] bool advance() noexcept;

  // s, the instant that was checked last.
  [[nodiscard]] double time() const noexcept { return time_; }
  // What the instants of the present narrow place, or of the whole motion, have shown.
  [[nodiscard]] const Rehearsal& result() const noexcept { return rehearsal_; }

 private:
  [[nodiscard]] double step() const noexcept;
  [[nodiscard]] double place_at(double time) const noexcept;
  [[nodiscard]] int instant_of(double place) const noexcept;
  bool begin_stretch(const NarrowPlace& narrow) noexcept;
  void next_stretch(double duration) noexcept;

  const Places& places_;
  Draft& draft_;
  const PathFindings& findings_;
  Rehearsal rehearsal_;
  Profile profile_;
  bool timed_ = false;
  double time_ = 0;
  std::size_t stretches_ = 0;  // that are still to be rehearsed, and the whole motion
};

}  // namespace indurop::robot
