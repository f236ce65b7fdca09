// SPDX-License-Identifier: Apache-2.0
// Samples where the tool will go in a planned motion, and how fast at full override, for people who watch it.

#pragma once

#include <indurop/robot/tool_way.h>

#include "control/robot/path/segment.h"

namespace indurop::robot {

class WayAhead {
 public:
  // The places are borrowed.
  WayAhead(const Places& places, const JointLimits& joints) noexcept : places_(places), joints_(joints) {}

  // Samples `segment`, which is followed after `before` by `blend`, if its zone is above 0; then `cut` is not null.
  // It receives the way of `before` up to the blend, which belongs to `way`; or no places, if there will be no time for
  // the blend. Real-time safe.
  void sample(const Segment& before, const Blend& blend, const Segment& segment, ToolWay* cut, ToolWay& way) noexcept;

 private:
  void add_part(const Segment& segment, double to, double exit, bool rests, std::size_t most, ToolWay& way) noexcept;

  const Places& places_;
  const JointLimits joints_;
  // Of the motion that was sampled last.
  ToolWay last_;
  std::size_t rounded_ = 0;  // places of it that belong to its blend
  double start_ = 0;         // the place after that blend, s at full speed, and the speed there
  double speed_ = 0;
};

}  // namespace indurop::robot
