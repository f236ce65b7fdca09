// SPDX-License-Identifier: Apache-2.0
// Starts, pauses and continues jobs: at their first line or another one, after a stop, one step further or back.

#include <algorithm>
#include <cstdio>

#include "control/robot/job/runner.h"

namespace indurop::robot {

bool JobRunner::start(int job, std::uint32_t line) noexcept {
  const auto& steps = book_.job(job).steps;
  const auto first = std::find_if(steps.begin(), steps.end(), [&](const Step& each) { return each.line >= line; });
  if (line > 0 && first == steps.end()) {
    return false;
  }
  state_ = JobState::Runs;
  jobs_.reset(job);
  job_ = job;
  waited_ = 0;
  question_.close();
  search_ = {};
  long_.reset();
  outputs_.followed.forget();
  places_.reset();
  values_.reset();
  settings_ = {};
  load_ = 0;
  line_ = stopped_ = shown_ = {job, 0};
  message_[0] = '\0';
  outputs_.on_path = {};
  interrupts_.reset();
  ticket_ = 0;
  pauses_.reset();
  in_job_ = first != steps.begin();
  for (auto before = steps.begin(); before != first; ++before) {
    if (before->formula < 0) {
      settings_.apply(*before);  // what would have to be computed is not known
    }
    long_.skip(*before);
    load_ = before->op == Op::Load ? before->index : load_;
  }
  jobs_.jump(static_cast<int>(first - steps.begin()));
  return true;
}

void JobRunner::resume() noexcept {
  if (interrupts_.is(Interrupts::Phase::Leaving)) {
    interrupts_.cancel_leaving();
  } else if (interrupts_.is(Interrupts::Phase::Returning)) {
    end_interrupt();
  }
  long_.pushing.resume();
  state_ = JobState::Runs;
  message_[0] = '\0';
  pauses_.pass();
}

bool JobRunner::is_in(int source) const noexcept {
  return MotionLine::of(source).job == jobs_.job();
}

void JobRunner::go_back(int source) noexcept {
  const auto& steps = jobs_.steps();
  const auto found = std::find_if(steps.begin(), steps.end(), [&](const Step& each) {
    return each.op == Op::Move && each.line == MotionLine::of(source).line;
  });
  jobs_.jump(static_cast<int>(found - steps.begin()));
  question_.close();
  line_ = {jobs_.job(), found->line};
  state_ = JobState::Paused;
  pauses_.reset();
}

void JobRunner::forget() noexcept {
  state_ = JobState::Idle;
  jobs_.reset();
  job_ = -1;
  waited_ = 0;
  question_.close();
  outputs_.on_path = {};
  search_ = {};
  long_.reset();
  outputs_.followed.forget();
  places_.reset();
  interrupts_.reset();
  pauses_.reset();
  line_ = stopped_ = shown_ = {};
  message_[0] = '\0';
}

OpenQuestion* JobRunner::open_question() noexcept {
  const bool waits = state_ == JobState::Waits && !interrupts_.is(Interrupts::Phase::Leaving) &&
                     !interrupts_.is(Interrupts::Phase::Returning);
  return waits && question_.is_open() ? &question_ : nullptr;
}

void JobRunner::set_message(const char* text) noexcept {
  std::snprintf(message_, sizeof message_, "%s", text);
}

}  // namespace indurop::robot
