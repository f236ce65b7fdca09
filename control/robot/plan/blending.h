// SPDX-License-Identifier: Apache-2.0
// Blends: the transition from one path to the next.

#pragma once

#include "control/robot/plan/path_clearance.h"

namespace indurop::robot {

// s that two segments and the blend between them take from rest to rest. Real-time safe.
[[nodiscard]] double duration(const Segment& first, const Blend& blend, const Segment& second) noexcept;

class Blending {
 public:
  // The limits are the arm's and the tool's own.
  Blending(const Places& places, const JointLimits& joints, const ToolLimits& tool, PathClearance& clearance) noexcept
      : places_(places), joints_(joints), tool_(tool), clearance_(clearance) {}

  // The blend of `first` into `second` within first.zone; the zone of the result is 0 if it cannot, or if stopping at
  // the corner is faster. Real-time safe unless collisions have to be checked.
  [[nodiscard]] Blend blend(const Segment& first, const Segment& second) noexcept;

 private:
  [[nodiscard]] double zone(const Segment& first, const Segment& second) const noexcept;
  [[nodiscard]] LineLimits limits(const Segment& first, const Blend& blend, const Segment& second) const noexcept;

  const Places& places_;
  const JointLimits& joints_;
  const ToolLimits& tool_;
  PathClearance& clearance_;
};

}  // namespace indurop::robot
