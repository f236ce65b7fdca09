// SPDX-License-Identifier: Apache-2.0
// TRY and RECOVER: the handling of an error between them.

#include <algorithm>
#include <cstdio>

#include "control/robot/job/runner.h"

namespace indurop::robot {

// The innermost TRY applies, also one around a CALL, but not one of an interrupted job.
bool JobRunner::recover(Fault fault, const char* why, int source, std::uint32_t ticket) noexcept {
  if (!running() || serving_ == Serving::Leaving || serving_ == Serving::Returning) {
    return false;
  }
  const int last = serving_ == Serving::Runs ? interrupted_.depth + 1 : 0;
  for (int depth = depth_; depth >= last; --depth) {
    const Frame& here = frames_[static_cast<std::size_t>(depth)];
    const auto& steps = job_of(here.job).steps;
    const auto at = static_cast<std::size_t>(here.step);
    if (at >= steps.size() || steps[at].guard < 0) {
      continue;
    }
    describe(why, source);
    for (Trigger& each : triggers_) {
      each.waits = each.waits && each.ticket < ticket;
    }
    depth_ = depth;
    const Step& guard = steps[static_cast<std::size_t>(steps[at].guard)];
    frame().variables[static_cast<std::size_t>(guard.mid)] = static_cast<double>(fault.code);
    jump(guard.index);
    state_ = JobState::Runs;
    waited_ = 0;
    return true;
  }
  return false;
}

// Adds file and line: of the motion `source`, or of the present step.
void JobRunner::describe(const char* why, int source) noexcept {
  const int job = source > 0 ? source >> kLineBits : frame().job;
  line_ = source > 0 ? line_of(source) : line_;
  line_job_ = job;
  const std::string& file = job_of(job).file;
  const char* name = file.c_str() + (file.find_last_of('/') + 1);
  std::snprintf(message_, sizeof message_, "%.80s:%u: %s", name, line_, why);
}

void JobRunner::refuse(Fault fault, const char* why) noexcept {
  constexpr std::uint32_t kNone = ~0U;  // all commanded motions are possible
  if (!recover(fault, why, 0, kNone)) {
    fail(fault, why, 0);
  }
}

}  // namespace indurop::robot
