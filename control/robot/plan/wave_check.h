// SPDX-License-Identifier: Apache-2.0
// Checks both sides of a wave along a path, before it is part of the path: whether the arm reaches them, and how fast
// the path may be followed for the wave alone. What wave and path need together is found by the rehearsal.

#pragma once

#include "control/robot/plan/path_findings.h"
#include "control/robot/plan/path_survey.h"

namespace indurop::robot {

class WaveCheck {
 public:
  WaveCheck(const Places& places, Draft& draft, PathSurvey& survey) noexcept
      : places_(places), draft_(draft), survey_(survey) {}

  // Begins with the draft's path, whose places are known. If it is done() then, there is no wave. Real-time safe, like
  // all functions of this class.
  void begin() noexcept;
  // Checks up to `places` more places and subtracts those it checked. When done(), the wave is part of the draft's
  // path. Errors: Wave, Unreachable, JointLimit, Singular, Workspace.
  Fault check(int& places) noexcept;
  [[nodiscard]] bool done() const noexcept { return next_ < 0; }

 private:
  Fault check_next() noexcept;
  // Limits of the path, `path` without its wave.
  [[nodiscard]] LineLimits bounded(const LineLimits& path) const noexcept;
  void finish() noexcept;

  const Places& places_;
  Draft& draft_;
  PathSurvey& survey_;
  int next_ = -1;
  // What a motion of the tool to the side takes of the limits of joints and tool: s/m, s^2/m, s^3/m.
  double of_speed_ = 0, of_acceleration_ = 0, of_jerk_ = 0;
};

}  // namespace indurop::robot
