// SPDX-License-Identifier: Apache-2.0
// Starts, pauses and continues jobs: at their first line or another one, after a stop, one step further or back.

#include <algorithm>
#include <cstdio>

#include "control/robot/job/runner.h"

namespace indurop::robot {

bool JobRunner::start(int job, std::uint32_t line) noexcept {
  const auto& steps = job_of(job).steps;
  const auto first = std::find_if(steps.begin(), steps.end(), [&](const Step& each) { return each.line >= line; });
  if (line > 0 && first == steps.end()) {
    return false;
  }
  state_ = JobState::Runs;
  depth_ = 0;
  frames_[0] = {};
  frames_[0].job = job;
  job_ = job;
  waited_ = 0;
  modal_ = {};
  tool_ = 0;
  load_ = 0;
  line_ = 0;
  line_job_ = job;
  message_[0] = '\0';
  triggers_ = {};
  watched_ = {};
  serving_ = Serving::None;
  ticket_ = present_ = 0;
  last_job_ = last_step_ = -1;
  free_ = false;
  in_job_ = first != steps.begin();
  for (auto before = steps.begin(); before != first; ++before) {
    if (before->op == Op::Speed || before->op == Op::Zone || before->op == Op::Acceleration) {
      modal(*before);
    } else if (before->op == Op::Tool) {
      tool_ = before->index;
    } else if (before->op == Op::Load) {
      load_ = before->index;
    }
  }
  jump(static_cast<int>(first - steps.begin()));
  return true;
}

void JobRunner::resume() noexcept {
  if (serving_ == Serving::Leaving) {
    serving_ = Serving::None;  // it is still pending
  } else if (serving_ == Serving::Returning) {
    end_interrupt();
  }
  state_ = JobState::Runs;
  message_[0] = '\0';
  free_ = true;
}

bool JobRunner::is_in(int source) const noexcept {
  return source >> kLineBits == frame().job;
}

void JobRunner::go_back(int source) noexcept {
  const auto& steps = job_of(frame().job).steps;
  const auto found = std::find_if(steps.begin(), steps.end(), [&](const Step& each) {
    return each.op == Op::Move && each.line == line_of(source);
  });
  jump(static_cast<int>(found - steps.begin()));
  line_ = found->line;
  line_job_ = frame().job;
  state_ = JobState::Paused;
  last_step_ = -1;
}

void JobRunner::forget() noexcept {
  state_ = JobState::Idle;
  depth_ = 0;
  frames_[0] = {};
  job_ = -1;
  waited_ = 0;
  triggers_ = {};
  watched_ = {};
  serving_ = Serving::None;
  served_ = -1;
  last_step_ = last_job_ = -1;
  line_ = 0;
  line_job_ = -1;
  message_[0] = '\0';
}

void JobRunner::say(const char* text) noexcept {
  std::snprintf(message_, sizeof message_, "%s", text);
}

// The other steps of a line belong to its first one, so there is no pause between them.
bool JobRunner::pauses_before(const Step& step) const noexcept {
  const int job = frame().job;
  const auto& steps = job_of(job).steps;
  const bool goes_on = job == last_job_ && last_step_ >= 0 && frame().step > last_step_ &&
                       steps[static_cast<std::size_t>(last_step_)].line == step.line;
  if (free_ || goes_on) {
    return false;
  }
  return single_ || std::any_of(breakpoints_.begin(), breakpoints_.end(), [&](const Breakpoint& each) {
           return each.line == step.line && each.job == static_cast<std::uint32_t>(job + 1);
         });
}

}  // namespace indurop::robot
