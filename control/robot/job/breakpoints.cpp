// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/breakpoints.h"

#include <algorithm>

namespace indurop::robot {

bool LineBreakpoints::before(const CallStack& jobs) const noexcept {
  const Step& step = *jobs.step();
  const bool in_line = jobs.job() == last_job_ && last_step_ >= 0 && jobs.index() > last_step_ &&
                       jobs.steps()[static_cast<std::size_t>(last_step_)].line == step.line;
  if (passes_ || in_line) {
    return false;
  }
  return each_ || std::any_of(breakpoints_.begin(), breakpoints_.end(), [&](const Breakpoint& each) {
           return each.line == step.line && each.job == static_cast<std::uint32_t>(jobs.job() + 1);
         });
}

}  // namespace indurop::robot
