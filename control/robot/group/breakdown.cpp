// SPDX-License-Identifier: Apache-2.0
#include "control/robot/group/breakdown.h"

#include <cstdio>

namespace indurop::robot {

void Breakdown::begin(const char* what, const char* how) noexcept {
  if (why_[0] == '\0') {
    std::snprintf(why_, sizeof why_, "%s crashed: %s", what, how);
    group_.trip(ErrorCode::Planner, 0, 1);
  }
}

void Breakdown::report(Outputs& out) noexcept {
  constexpr double kPatience = 1;  // s; a drive that is still on by then stays on
  const bool rests = why_[0] != '\0' && !robot_.states.stopping();
  rested_ += rests ? robot_.period : 0;
  out.broken =
      rests && (!(robot_.axes.any_enabled() || robot_.singles.any_enabled()) || rested_ > kPatience) ? why_ : nullptr;
}

}  // namespace indurop::robot
