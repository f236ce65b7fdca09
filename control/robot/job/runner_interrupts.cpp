// SPDX-License-Identifier: Apache-2.0
// What breaks the order of the steps: interrupts, which are served between two steps, motions that a condition ends,
// and errors, which end the job unless it is between TRY and RECOVER.

#include <cstdio>

#include "control/robot/job/runner.h"

namespace indurop::robot {

// Called once per period. Returns true if the job does nothing else in this period.
bool JobRunner::serve_interrupts(Signals& signals, MotionPort& port) noexcept {
  interrupts_.monitor(signals);
  if (interrupts_.is(Interrupts::Phase::None) || interrupts_.is(Interrupts::Phase::Running)) {
    if (!interrupts_.any_due() || search_.met || long_.off_path()) {
      return false;  // what comes to rest for UNTIL has no path to return to, others are not on their path
    }
    if (jobs_.is_full()) {
      fail({ErrorCode::Line}, "an interrupt came here, but jobs call each other too deep for another one", 0);
      return true;
    }
    interrupts_.begin_leaving();
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
  interrupted_[interrupts_.served()] = {
      state_,  jobs_.depth(), waited_, question_.asked(), settings_, outputs_.on_path, search_, places_.found(),
      in_job_, line_,         shown_};
  state_ = JobState::Runs;
  waited_ = 0;
  question_.close();
  outputs_.on_path.clear();
  search_ = {};
  settings_.wave = -1;
  in_job_ = false;
  jobs_.call(interrupts_.begin(), {});
}

JobRunner::Next JobRunner::leave_interrupt(MotionPort& port) noexcept {
  Fault fault;
  if (!outputs_.on_path.any() && port.settled() && long_.end(port) && port.come_back(fault)) {
    interrupts_.begin_return();
  } else if (!fault.ok()) {
    fail(fault,
         "this job was called by ON and has ended too far from where the path was left (regain_distance, or 45 deg of "
         "an axis); end it with MOVJ BACK",
         0);
  }
  return Next::Wait;
}

void JobRunner::end_interrupt() noexcept {
  const Interrupted& left = interrupted_[interrupts_.served() - 1];
  jobs_.return_to(left.depth);
  state_ = left.state;
  waited_ = left.waited;
  question_.set_asked(left.asked);
  settings_ = left.settings;
  outputs_.on_path = left.outputs;
  search_ = left.search;
  places_.set_found(left.found);
  in_job_ = left.in_job;
  line_ = left.line;
  interrupts_.end();
}

JobRunner::Next JobRunner::search(const Step& step, Signals& signals, MotionPort& port) noexcept {
  const MotionExtras& extras = *book_.extras_of(step);
  const bool begins = search_.ticket == 0;
  const bool settled = port.settled();
  if (!search_.met) {
    double met = 0;
    if (const auto flaw = values_.number(extras.until, signals, port, met); !flaw.ok()) {
      port.halt();
      return done(flaw);
    }
    // A condition that is true before the robot moves is met where it stands.
    search_.met = met != 0 && (begins || settled || port.place().ticket == search_.ticket);
    if (search_.met) {
      const Joints at = port.measured();
      places_.set_found({true, at, port.tip_at(at)});
    } else if (begins) {
      if (command_motion(step, signals, port)) {
        search_.ticket = ticket_;
        places_.set_found({});  // only now, since the motion may begin at what was found before
      }
      return Next::Wait;
    }
  }
  if (!settled) {
    if (search_.met) {
      port.halt();
    }
    return Next::Wait;
  }
  const bool found = search_.met;
  search_ = {};
  if (!found && extras.has_to_find) {
    refuse({ErrorCode::Line}, "the search came to its end and found nothing");
    return Next::Wait;
  }
  return Next::Go;
}

bool JobRunner::recover(Fault fault, const char* why, int source, std::uint32_t ticket) noexcept {
  const MotionLine shown = source > 0 ? MotionLine::of(source) : line_;
  if (!continue_after(static_cast<double>(fault.code), ticket)) {
    return false;
  }
  describe(why, shown.source());
  line_ = stopped_;  // until the step after RECOVER runs, at rest
  return true;
}

// The innermost TRY applies, also one around a CALL, but not one of an interrupted job.
bool JobRunner::continue_after(double number, std::uint32_t ticket) noexcept {
  if (!running() || interrupts_.is(Interrupts::Phase::Leaving) || interrupts_.is(Interrupts::Phase::Returning)) {
    return false;
  }
  const int last = interrupts_.served() > 0 ? interrupted_[interrupts_.served() - 1].depth + 1 : 0;
  for (int depth = jobs_.depth(); depth >= last; --depth) {
    const Step* const step = jobs_.step_at(depth);
    if (step == nullptr || step->guard < 0) {
      continue;
    }
    outputs_.on_path.discard_from(ticket);
    jobs_.return_to(depth);
    const Step& guard = jobs_.steps()[static_cast<std::size_t>(step->guard)];
    jobs_.variables()[static_cast<std::size_t>(guard.mid)] = number;
    jobs_.jump(guard.index);
    state_ = JobState::Runs;
    waited_ = 0;
    question_.close();
    search_ = {};
    long_.pushing.reset();
    return true;
  }
  return false;
}

// Adds file and line: of the motion `source`, or of the present step.
void JobRunner::describe(const char* why, int source, unsigned column) noexcept {
  stopped_ = source > 0 ? MotionLine::of(source) : source == kReported && shown_.line > 0 ? shown_ : line_;
  const std::string& file = book_.job(stopped_.job).file;
  const char* name = file.c_str() + (file.find_last_of('/') + 1);
  if (column > 0) {
    std::snprintf(message_, sizeof message_, "%.80s:%u:%u: %s", name, stopped_.line, column, why);
  } else {
    std::snprintf(message_, sizeof message_, "%.80s:%u: %s", name, stopped_.line, why);
  }
}

void JobRunner::refuse(Fault fault, const char* why, unsigned column, double number) noexcept {
  constexpr std::uint32_t kNone = ~0U;  // all commanded motions are possible
  if (!running()) {
    return;
  }
  describe(why, 0, column);
  if (!continue_after(number > 0 ? number : static_cast<double>(fault.code), kNone)) {
    state_ = JobState::Failed;
    fault_ = fault;
  }
}

JobRunner::Next JobRunner::raise(const Step& step, Signals& signals, const MotionPort& port) noexcept {
  double number = 0;
  if (!compute(step.formula, signals, port, number)) {
    return Next::Wait;
  }
  if (!(number > 0)) {
    return done({"RAISE takes the number of an error, above 0", 0});
  }
  char why[sizeof message_];
  std::snprintf(why, sizeof why, "error %g was raised", number);
  if (step.mid >= 0 && done(values_.text(step.mid, signals, port, why)) == Next::Wait) {
    return Next::Wait;
  }
  refuse({ErrorCode::Line}, why, 0, number);
  return Next::Wait;
}

}  // namespace indurop::robot
