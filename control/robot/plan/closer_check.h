// SPDX-License-Identifier: Apache-2.0
// The closer check of parts of a path, where more may happen between two places than they show.

#pragma once

#include <array>
#include <cstddef>

#include "control/robot/kinematics/errors.h"
#include "control/robot/plan/path_findings.h"

namespace indurop::robot {

class CloserCheck {
 public:
  static constexpr int kPlaces = 8;  // that a part is checked at

  CloserCheck(const Places& places, Draft& draft, PathFindings& findings) noexcept
      : places_(places), draft_(draft), findings_(findings) {}

  // Begins without parts. Real-time safe, like all functions of this class.
  void begin() noexcept { count_ = 0; }
  // Chooses the parts to be checked among those between `count` + 1 places, `spacing` apart from `from` on, whose joint
  // angles and volumes (0 in singular positions) are known. `depth`: how often they were divided already.
  void choose(const Joints* places, const double* volumes, int count, double from, double spacing, int depth) noexcept;
  [[nodiscard]] bool done() const noexcept { return count_ == 0; }
  // Checks the next part; requires !done(). Errors: Unreachable, JointLimit, Singular.
  Fault check_next() noexcept;

 private:
  struct Part {
    double from = 0;
    double length = 0;
    Joints start;
    Joints end;
    int depth = 0;
  };

  [[nodiscard]] bool may_leave_range(const Joints* places, int count, int i) const noexcept;

  const Places& places_;
  Draft& draft_;
  PathFindings& findings_;
  std::array<Part, 256> parts_{};
  std::size_t count_ = 0;
};

}  // namespace indurop::robot
