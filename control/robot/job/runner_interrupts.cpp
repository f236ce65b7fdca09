// SPDX-License-Identifier: Apache-2.0
// What breaks the order of the steps: interrupts, which are served between two steps, and errors, which end the job
// unless it is between TRY and RECOVER.

#include <cstdio>

#include "control/robot/job/motion_line.h"
#include "control/robot/job/runner.h"

namespace indurop::robot {

// Called once per period. Returns true if the job does nothing else in this period.
bool JobRunner::serve_interrupts(Signals& signals, MotionPort& port) noexcept {
  interrupts_.monitor(signals);
  if (interrupts_.is(Interrupts::Phase::None)) {
    if (!interrupts_.any_pending()) {
      return false;
    }
    if (jobs_.is_full()) {
      fail({ErrorCode::Line}, "an interrupt came here, but jobs call each other too deep for another one", 0);
      return true;
    }
    interrupts_.serve_first();
  }
  if (interrupts_.is(Interrupts::Phase::Leaving)) {
    if (!port.step_aside()) {
      return true;
    }
    begin_interrupt();
  } else if (interrupts_.is(Interrupts::Phase::Returning)) {
    if (port.is_back()) {
      end_interrupt();
    }
    return true;
  }
  return false;
}

void JobRunner::begin_interrupt() noexcept {
  interrupted_ = {state_, jobs_.depth(), waited_, settings_, outputs_, in_job_};
  state_ = JobState::Runs;
  waited_ = 0;
  outputs_.clear();
  in_job_ = false;
  jobs_.call(interrupts_.begin(), {});
}

JobRunner::Next JobRunner::leave_interrupt(MotionPort& port) noexcept {
  Fault fault;
  if (!outputs_.any() && port.settled() && port.come_back(fault)) {
    interrupts_.begin_return();
  } else if (!fault.ok()) {
    fail(fault, "this job was called by ON and has ended too far from where the path was left; end it with MOVJ BACK",
         0);
  }
  return Next::Wait;
}

void JobRunner::end_interrupt() noexcept {
  const Interrupted& left = interrupted_;
  jobs_.return_to(left.depth);
  state_ = left.state;
  waited_ = left.waited;
  settings_ = left.settings;
  outputs_ = left.outputs;
  in_job_ = left.in_job;
  interrupts_.end();
}

// The innermost TRY applies, also one around a CALL, but not one of an interrupted job.
bool JobRunner::recover(Fault fault, const char* why, int source, std::uint32_t ticket) noexcept {
  if (!running() || interrupts_.is(Interrupts::Phase::Leaving) || interrupts_.is(Interrupts::Phase::Returning)) {
    return false;
  }
  const int last = interrupts_.is(Interrupts::Phase::Running) ? interrupted_.depth + 1 : 0;
  for (int depth = jobs_.depth(); depth >= last; --depth) {
    const Step* const step = jobs_.step_at(depth);
    if (step == nullptr || step->guard < 0) {
      continue;
    }
    describe(why, source);
    outputs_.discard_from(ticket);
    jobs_.return_to(depth);
    const Step& guard = jobs_.steps()[static_cast<std::size_t>(step->guard)];
    jobs_.variables()[static_cast<std::size_t>(guard.mid)] = static_cast<double>(fault.code);
    jobs_.jump(guard.index);
    state_ = JobState::Runs;
    waited_ = 0;
    return true;
  }
  return false;
}

// Adds file and line: of the motion `source`, or of the present step.
void JobRunner::describe(const char* why, int source) noexcept {
  const MotionLine shown = source > 0 ? MotionLine::of(source) : MotionLine{jobs_.job(), line_};
  line_ = shown.line;
  line_job_ = shown.job;
  const std::string& file = job_of(shown.job).file;
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
