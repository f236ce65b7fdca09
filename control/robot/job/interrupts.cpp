// SPDX-License-Identifier: Apache-2.0
// Interrupts of a job: conditions that are monitored while it runs. One that becomes true stops the robot on its path;
// the job it calls runs, the robot returns, and the interrupted job continues.

#include <algorithm>
#include <cmath>

#include "control/robot/job/runner.h"

namespace indurop::robot {

bool JobRunner::holds(int interrupt, Signals& signals) const noexcept {
  const auto formula = static_cast<std::size_t>(book_.interrupts[static_cast<std::size_t>(interrupt)].formula);
  const double value = book_.formulas[formula].value({}, signals);
  return !std::isnan(value) && value != 0;
}

// Arms an interrupt. A condition that is already true has to become false before it triggers.
JobRunner::Next JobRunner::arm(const Step& step, Signals& signals) noexcept {
  if (step.op == Op::Arm) {
    Watched& one = watched_[static_cast<std::size_t>(step.slot)];
    one = one.on ? one : Watched{true, holds(step.slot, signals), false};
    return Next::Go;
  }
  for (std::size_t i = 0; i < book_.interrupts.size(); ++i) {
    watched_[i] = book_.interrupts[i].job == step.index ? Watched{} : watched_[i];
  }
  return Next::Go;
}

// Called once per period. Returns true if the job does nothing else in this period.
bool JobRunner::interrupt(Signals& signals, MotionPort& port) noexcept {
  for (std::size_t i = 0; i < book_.interrupts.size(); ++i) {
    Watched& one = watched_[i];
    if (one.on) {
      const bool now = holds(static_cast<int>(i), signals);
      one.pending = one.pending || (now && !one.was);
      one.was = now;
    }
  }
  if (serving_ == Serving::None) {
    const auto* const first =
        std::find_if(watched_.begin(), watched_.end(), [](const Watched& each) { return each.pending; });
    if (first == watched_.end()) {
      return false;
    }
    if (depth_ + 1 >= kDeepest) {
      fail({ErrorCode::Line}, "an interrupt came here, but jobs call each other too deep for another one", 0);
      return true;
    }
    served_ = static_cast<int>(first - watched_.begin());
    serving_ = Serving::Leaving;
  }
  if (serving_ == Serving::Leaving) {
    if (!port.step_aside()) {
      return true;
    }
    begin_interrupt();
  } else if (serving_ == Serving::Returning) {
    if (port.is_back()) {
      end_interrupt();
    }
    return true;
  }
  return false;
}

void JobRunner::begin_interrupt() noexcept {
  interrupted_ = {state_, depth_, waited_, modal_, tool_, triggers_, present_, since_, in_job_};
  watched_[static_cast<std::size_t>(served_)].pending = false;
  serving_ = Serving::Runs;
  state_ = JobState::Runs;
  waited_ = 0;
  triggers_ = {};
  in_job_ = false;
  ++depth_;
  frame() = {};
  frame().job = book_.interrupts[static_cast<std::size_t>(served_)].job;
}

JobRunner::Next JobRunner::leave_interrupt(MotionPort& port) noexcept {
  const bool waits = std::any_of(triggers_.begin(), triggers_.end(), [](const Trigger& each) { return each.waits; });
  Fault fault;
  if (!waits && port.settled() && port.come_back(fault)) {
    serving_ = Serving::Returning;
  } else if (!fault.ok()) {
    fail(fault, "this job was called by ON and has ended too far from where the path was left; end it with MOVJ BACK",
         0);
  }
  return Next::Wait;
}

void JobRunner::end_interrupt() noexcept {
  const Interrupted& left = interrupted_;
  depth_ = left.depth;
  state_ = left.state;
  waited_ = left.waited;
  modal_ = left.modal;
  tool_ = left.tool;
  triggers_ = left.triggers;
  present_ = left.present;
  since_ = left.since;
  in_job_ = left.in_job;
  serving_ = Serving::None;
  served_ = -1;
}

}  // namespace indurop::robot
