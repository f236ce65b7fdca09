// SPDX-License-Identifier: Apache-2.0
// Motion of a single axis by a time table.

#include <algorithm>

#include "control/robot/axis/motion.h"

namespace indurop::robot {

void AxisMotion::move_along(const TimeProfile& table, const LineLimits& limits, bool to_rest) noexcept {
  goal_ = Goal::Table;
  table_ = table;
  limits_ = limits;
  rests_ = to_rest;
  went_through_.reset();
  passing_ = passed_ = harder_ = false;
  time_ = 0;
}

void AxisMotion::step_along() noexcept {
  const double left = time_ - table_.duration();
  state_ = table_.at(std::min(time_, table_.duration()));
  if (left < 0) {
    return;
  }
  if (rests_) {
    reset({state_.position, 0, 0});
    return;
  }
  goal_ = Goal::Velocity;
  target_ = unloaded(state_, limits_);
  plan();
  time_ = left;
  state_ = on_profile(left);
}

}  // namespace indurop::robot
