// SPDX-License-Identifier: Apache-2.0
// Checks places all along a path for reach, joint limits, singular positions and the workspace, a few at a time, and
// keeps their joint angles.

#pragma once

#include <array>

#include "control/robot/kinematics/workspace.h"
#include "control/robot/plan/closer_check.h"
#include "control/robot/plan/path_findings.h"

namespace indurop::robot {

class PathSurvey {
 public:
  PathSurvey(const Places& places, Draft& draft) noexcept;

  // Begins with the draft's path, of the tool and not 0 long. Real-time safe, like all functions of this class.
  void begin() noexcept;
  // Checks up to `places` more places and subtracts those it checked. When done() it has set the draft's end and tip
  // speed. Errors: Unreachable, JointLimit, Singular, Workspace.
  Fault check(int& places) noexcept;
  [[nodiscard]] bool done() const noexcept { return next_ > count_ && closer_.done(); }

  // The joint angles at count() + 1 equally spaced places.
  [[nodiscard]] const Joints* samples() const noexcept { return samples_.data(); }
  [[nodiscard]] int count() const noexcept { return count_; }
  // Sets `q` if the joint angles at this place of the path are known. Otherwise returns false; `q` is then what is
  // known nearest to it, or `near` if that is not near.
  bool find(double place, const Joints& near, Joints& q) const noexcept;
  // Part of full speed that the path would reach without the joints' limits.
  [[nodiscard]] double wanted() const noexcept { return wanted_; }
  [[nodiscard]] PathFindings& findings() noexcept { return findings_; }

 private:
  static constexpr int kMaxPlaces = 256;

  Fault check_next() noexcept;
  Fault finish() noexcept;
  void learn() noexcept;

  const Places& places_;
  Draft& draft_;
  PathFindings findings_;
  CloserCheck closer_;
  WayInside inside_;
  std::array<Joints, kMaxPlaces + 1> samples_{};
  std::array<double, kMaxPlaces + 1> volumes_{};
  int count_ = 0;  // places after the first
  int next_ = 1;
  double wanted_ = 1;
};

}  // namespace indurop::robot
