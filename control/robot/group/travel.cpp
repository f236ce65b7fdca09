// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/travel.h"

namespace indurop::robot {

// Both positions are those of the present tool, so the exchange of a tool is no motion.
void Travel::step(const Arm& arm, const Joints& set_points, bool leads, bool followed, double seconds) noexcept {
  const bool goes_on = followed && leads && seen_.leads;
  const double moved = goes_on ? (arm.forward(set_points).position - arm.forward(last_).position).norm() : 0;
  last_ = set_points;
  seen_.before = state_;
  seen_.leads = leads;
  const double velocity = moved / seconds;
  state_ = {state_.position + moved, velocity, goes_on ? (velocity - state_.velocity) / seconds : 0};
  seen_.now = state_.position;
}

}  // namespace indurop::robot
