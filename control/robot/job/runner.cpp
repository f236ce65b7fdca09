// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/runner.h"

#include <algorithm>

#include "control/robot/job/step_needs.h"

namespace indurop::robot {

namespace {

constexpr int kStepsPerPeriod = 64;  // an endless loop without waiting continues in the next period

// A tool that presses no longer does in this period.
bool come_to_rest(MotionPort& port) noexcept {
  if (!port.rests()) {
    port.press({});
    return false;
  }
  return true;
}

}  // namespace

bool JobRunner::compute(int formula, Signals& signals, const MotionPort& port, double& value) noexcept {
  return done(values_.number(formula, signals, port, value)) == Next::Go;
}

JobRunner::Next JobRunner::done(const StepValues::Flaw& flaw) noexcept {
  if (flaw.ok()) {
    return Next::Go;
  }
  refuse({ErrorCode::Line}, flaw.why, flaw.column);
  return Next::Wait;
}

void JobRunner::stop() noexcept {
  if (running()) {
    stopped_ = shown_;
    state_ = JobState::Idle;
  }
}

void JobRunner::fail(Fault fault, const char* why, int source, unsigned column) noexcept {
  if (!running()) {
    return;
  }
  state_ = JobState::Failed;
  fault_ = fault;
  describe(why, source, column);
}

JobReport JobRunner::report(const JobProgress& now) noexcept {
  const bool back = running() && interrupts_.is(Interrupts::Phase::Returning);
  const bool stopped = state_ == JobState::Failed || state_ == JobState::Idle;
  const std::size_t served = interrupts_.served() - (back ? 1 : 0);  // the job to which it returns is not interrupted
  if (back) {
    shown_ = interrupted_[served].shown;
  } else if (now.source > 0 && (running() || state_ == JobState::Idle || now.returns)) {
    shown_ = MotionLine::of(now.source);
  } else {
    shown_ = stopped ? stopped_ : line_;
  }
  JobReport report;
  report.state = back || now.returns ? JobState::Resumes : state_;
  report.job = static_cast<std::uint32_t>(job_ + 1);
  report.line = shown_.line;
  report.cycles = cycles_;
  report.name = job_ >= 0 ? book_.job(job_).name.c_str() : "";
  report.called = job_ >= 0 && shown_.job >= 0 ? book_.job(shown_.job).name.c_str() : report.name;
  report.message = now.returns ? "" : message_;
  if (!running() && !now.kept) {
    return report;
  }
  report.interrupted_count = static_cast<std::uint16_t>(served);
  for (std::size_t i = 0; i < served; ++i) {
    const MotionLine& left = interrupted_[i].shown;
    report.interrupted[i] = {book_.job(left.job).name.c_str(), left.line};
  }
  std::array<int, kReportedPending> jobs{};
  const std::size_t count = interrupts_.pending(jobs);
  report.pending_count = static_cast<std::uint16_t>(count);
  for (std::size_t i = 0; i < std::min(count, jobs.size()); ++i) {
    report.pending[i] = book_.job(jobs[i]).name.c_str();
  }
  return report;
}

void JobRunner::step(double seconds, Signals& signals, MotionPort& port) noexcept {
  const PathPlace place = port.place();
  if (!interrupts_.is(Interrupts::Phase::Leaving) || place.ticket != 0) {
    outputs_.on_path.step(seconds, place, port.settled(), signals, outputs_.pulses);
  }
  if (!running() || serve_interrupts(signals, port)) {
    return;
  }
  values_.pass(seconds);
  if (const auto flaw = long_.correcting.step(seconds, values_, signals, port); !flaw.ok()) {
    // A value that is missing is wrong in its own line; anything else happens on the way.
    fail({ErrorCode::Line}, flaw.why, flaw.column > 0 ? long_.correcting.source() : kReported, flaw.column);
    return;
  }
  bool first = true;
  for (int left = kStepsPerPeriod; left > 0 && running(); first = false) {
    const Step* step = jobs_.step();
    left -= step == nullptr ? 1 : cost_of(book_, *step);
    Next next = Next::Wait;
    if (step == nullptr) {
      next = leave(signals, port);
    } else if (search_.ticket == 0 && !long_.riding.rides() && !long_.pushing.on() && pauses_.before(jobs_)) {
      if (come_to_rest(port)) {
        state_ = JobState::Paused;
        line_ = {jobs_.job(), step->line};
      }
      return;
    } else if (search_.ticket != 0 || long_.pushing.on() || !touches_world(book_, *step) || port.settled()) {
      line_ = {jobs_.job(), step->line};
      pauses_.note(jobs_);
      next = run(*step, first ? seconds : 0, signals, port);
    }
    if (next == Next::Wait) {
      return;
    }
    waited_ = 0;
    pauses_.note_end();
    state_ = running() ? JobState::Runs : state_;
  }
}

// While an interrupt is served, outputs do not follow its motions.
bool JobRunner::step_outputs(double seconds, Signals& signals, const MotionPort& port) noexcept {
  outputs_.pulses.step(seconds, signals);
  const bool live = running() && interrupts_.is(Interrupts::Phase::None);
  int source = 0;
  const auto flaw = outputs_.followed.step(live, values_, signals, port, source);
  if (!flaw.ok()) {
    fail({ErrorCode::Line}, flaw.why, source, flaw.column);
  }
  return flaw.ok();
}

JobRunner::Next JobRunner::leave(Signals& signals, MotionPort& port) noexcept {
  if (interrupts_.is(Interrupts::Phase::Running) && jobs_.depth() == interrupted_[interrupts_.served() - 1].depth + 1) {
    return leave_interrupt(port);
  }
  if (jobs_.depth() > 0) {
    if (jobs_.lacks_value()) {
      refuse({ErrorCode::Line}, "this job ends without the value that its caller waits for; end it with RETURN and it");
      return Next::Wait;
    }
    jobs_.finish();
    return Next::Go;
  }
  if (port.settled() && long_.riding.end(port) && come_to_rest(port)) {
    long_.correcting.reset();
    outputs_.followed.reset(signals);
    state_ = JobState::Ended;
    ++cycles_;
  }
  return Next::Wait;
}

// Long: one case for each kind of step.
JobRunner::Next JobRunner::run(const Step& step, double seconds, Signals& signals, MotionPort& port) noexcept {
  Next next = Next::Go;
  switch (step.op) {
    case Op::Move:
      if (has_until(book_, step)) {
        next = search(step, signals, port);
      } else {
        next = command_motion(step, signals, port) ? Next::Go : Next::Wait;
      }
      break;
    case Op::Place:
      next = done(values_.compute_place(step, signals, port));
      break;
    case Op::WaitUntil:
    case Op::WaitTime:
    case Op::Ask:
      next = wait(step, seconds, signals, port);
      break;
    case Op::Call:
      return call(step, signals, port);
    case Op::Arm:
      interrupts_.arm(step.slot, signals);
      break;
    case Op::Disarm:
      interrupts_.disarm(step.index);
      break;
    case Op::Return:
      return done(values_.give_back(step, signals, port));
    case Op::Message:
      next = done(values_.text(step.mid, signals, port, message_));
      break;
    case Op::Raise:
      return raise(step, signals, port);
    case Op::Speed:
    case Op::Zone:
    case Op::Acceleration:
    case Op::Axis:
    case Op::Weave:
      if (Step with; (next = done(values_.setting(step, signals, port, with))) == Next::Go) {
        settings_.apply(with);
      }
      break;
    case Op::Set:
    case Op::SetOnPath:
      next = output(step, signals, port);
      break;
    case Op::Follow:
      next = done(outputs_.followed.run(step, MotionLine{jobs_.job(), step.line}.source(), signals));
      break;
    case Op::Tool:
    case Op::Load:
    case Op::Correct:
    case Op::Push:
    case Op::Track:
      next = select(step, seconds, signals, port);
      break;
    case Op::Assign:
      next = done(values_.assign(step, signals, port));
      break;
    case Op::Try:
    case Op::Recover:
      break;
    case Op::Goto:
      jobs_.jump(step.index);
      return Next::Go;
    case Op::If:
    case Op::Unless:
      return branch(step, signals, port);
    case Op::Again:
    case Op::EndTry:
      jobs_.go_to(step.index);
      return Next::Go;
    case Op::Loop:
      jobs_.begin_loop(step);
      break;
    case Op::End:
      jobs_.end_loop(step);
      return Next::Go;
  }
  if (next == Next::Go) {
    jobs_.advance();
  }
  return next;
}

JobRunner::Next JobRunner::select(const Step& step, double seconds, Signals& signals, MotionPort& port) noexcept {
  bool is_done = false;
  StepValues::Flaw flaw;
  const int source = MotionLine{jobs_.job(), step.line}.source();
  if (step.op == Op::Track) {
    flaw = long_.riding.run(step, places_, port, is_done);
  } else if (long_.riding.rides()) {
    flaw = {"tool, load and correction must not change, nor an axis push, while the tool moves with a belt; TRACK OFF"};
  } else if (step.op == Op::Correct) {
    flaw = long_.correcting.run(step, source, places_, port, is_done);
  } else if (long_.correcting.on()) {
    flaw = {"tool and load must not change, nor an axis push, while CORRECT or PRESS is on; its OFF comes before"};
  } else if (step.op == Op::Push) {
    flaw = long_.pushing.run(step, seconds, source, signals, port, is_done);
  } else {
    is_done = step.op == Op::Tool ? port.take_tool(step.index) : port.take_load(step.index);
  }
  if (done(flaw) == Next::Wait || !is_done) {
    return Next::Wait;
  }
  settings_.apply(step);
  return Next::Go;
}

bool JobRunner::command_motion(const Step& step, Signals& signals, MotionPort& port) noexcept {
  if (!port.ready()) {
    return false;
  }
  bool is_ready = false;
  if (done(long_.correcting.check(step)) == Next::Wait ||
      done(long_.riding.prepare(step, places_, port, is_ready)) == Next::Wait || !is_ready) {
    return false;
  }
  if (in_job_ && (step.move == Move::Circle || step.move == Move::Spline)) {
    refuse({ErrorCode::Line}, "a job cannot begin with a circle or a spline; begin with the motion before it");
    return false;
  }
  in_job_ = false;
  MoveCommand command;
  if (done(motions_.make(step, settings_, signals, port, command)) == Next::Wait) {
    return false;
  }
  command.source = MotionLine{jobs_.job(), step.line}.source();
  const auto following = static_cast<std::size_t>(jobs_.index()) + 1;
  command.alone = command.alone || (following < jobs_.steps().size() && jobs_.steps()[following].op == Op::SetOnPath);
  command.ticket = ++ticket_;
  if (const Fault fault = port.move(command); !fault.ok()) {
    fail(fault, to_string(fault.code), command.source);
    return false;
  }
  return true;
}

JobRunner::Next JobRunner::output(const Step& step, Signals& signals, const MotionPort& port) noexcept {
  bool is_done = false;
  return done(outputs_.run(step, ticket_, values_, signals, port, is_done)) == Next::Go && is_done ? Next::Go
                                                                                                   : Next::Wait;
}

JobRunner::Next JobRunner::branch(const Step& step, Signals& signals, const MotionPort& port) noexcept {
  double value = 0;
  if (!compute(step.formula, signals, port, value)) {
    return Next::Wait;
  }
  if (step.op == Op::If && value != 0) {
    jobs_.jump(step.index);
  } else if (step.op == Op::Unless && value == 0) {
    jobs_.go_to(step.index);
  } else {
    jobs_.advance();
  }
  return Next::Go;
}

JobRunner::Next JobRunner::wait(const Step& step, double seconds, Signals& signals, const MotionPort& port) noexcept {
  constexpr double kRounding = 1e-9;
  if (step.op == Op::WaitTime) {
    // The period in which the wait begins is not counted, so that a wait is never shorter than written.
    waited_ += state_ == JobState::Waits ? seconds : 0;
    state_ = JobState::Waits;
    return waited_ + kRounding >= step.value ? Next::Go : Next::Wait;
  }
  double met = 0;
  const auto flaw = step.op == Op::Ask ? question_.ask(step, waited_, values_, signals, port, met)
                                       : values_.number(step.formula, signals, port, met);
  if (done(flaw) == Next::Wait) {
    return Next::Wait;
  }
  if (met != 0) {
    return Next::Go;
  }
  state_ = JobState::Waits;
  waited_ += seconds;
  if (step.timeout <= 0 || waited_ < step.timeout) {
    return Next::Wait;
  }
  question_.close();
  if (step.index < 0) {
    refuse({ErrorCode::Line},
           step.op == Op::Ask ? "the question was not answered in time" : "the condition did not become true in time");
    return Next::Wait;
  }
  jobs_.go_to(step.index - 1);  // from which run() advances
  return Next::Go;
}

JobRunner::Next JobRunner::call(const Step& step, Signals& signals, const MotionPort& port) noexcept {
  if (jobs_.is_full()) {
    refuse({ErrorCode::Line}, "jobs call each other too deep; does one call itself without end?");
    return Next::Wait;
  }
  CallStack::Variables arguments{};
  const auto count = static_cast<std::size_t>(step.mid);
  if (done(values_.numbers(step.formula, count, signals, port, arguments.data())) == Next::Wait) {
    return Next::Wait;
  }
  jobs_.advance();
  jobs_.call(step.index, arguments, step.slot);
  return Next::Go;
}

}  // namespace indurop::robot
