// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/runner.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "control/robot/job/motion_line.h"

namespace indurop::robot {

namespace {

constexpr int kStepsPerPeriod = 64;  // an endless loop without waiting continues in the next period
constexpr int kPartsPerStep = 4;     // of formulas; a longer formula counts as several steps
constexpr int kOffsets = 3;          // x, y, z

std::span<const Formula> formulas_of(const JobBook& book, const Step& step) noexcept {
  if (step.formula < 0) {
    return {};
  }
  const auto first = static_cast<std::size_t>(step.formula);
  switch (step.op) {
    case Op::Call:
      return std::span(book.formulas).subspan(first, static_cast<std::size_t>(step.mid));
    case Op::Move:
      return std::span(book.formulas).subspan(first, kOffsets);
    default:
      return std::span(book.formulas).subspan(first, 1);
  }
}

// Returns whether the step reads or changes the outside world.
bool touches_world(const JobBook& book, const Step& step) noexcept {
  const auto formulas = formulas_of(book, step);
  return step.op == Op::Set || step.op == Op::WaitUntil || step.op == Op::WaitTime || step.op == Op::Tool ||
         step.op == Op::Load || step.op == Op::Arm || step.op == Op::Disarm || step.op == Op::Try ||
         step.op == Op::EndTry || step.op == Op::Recover ||
         std::any_of(formulas.begin(), formulas.end(), [](const Formula& each) { return each.reads_signals(); });
}

int cost_of(const JobBook& book, const Step& step) noexcept {
  int parts = 0;
  for (const Formula& formula : formulas_of(book, step)) {
    parts += static_cast<int>(formula.size());
  }
  return 1 + parts / kPartsPerStep;
}

}  // namespace

bool JobRunner::compute(int formula, Signals& signals, double& value) noexcept {
  value = book_.formulas[static_cast<std::size_t>(formula)].value(jobs_.variables(), signals);
  if (std::isnan(value)) {
    refuse({ErrorCode::Line}, "this has no value; is there a division by 0?");
  }
  return !std::isnan(value);
}

void MotionSettings::apply(const Step& step) noexcept {
  if (step.op == Op::Zone) {
    zone = step.value;
  } else if (step.op == Op::Acceleration) {
    acceleration = step.value;
  } else if (step.op == Op::Tool) {
    tool = step.index;
  } else if (step.op == Op::Speed && step.index == 1) {
    tool_speed = step.value;
  } else if (step.op == Op::Speed) {
    speed = step.value;
    tool_speed = 0;
  }
}

void JobRunner::stop() noexcept {
  if (running()) {
    state_ = JobState::Idle;
  }
}

void JobRunner::fail(Fault fault, const char* why, int source) noexcept {
  if (!running()) {
    return;
  }
  state_ = JobState::Failed;
  fault_ = fault;
  describe(why, source);
}

JobReport JobRunner::report(int source) const noexcept {
  JobReport report;
  report.state = state_;
  report.job = static_cast<std::uint32_t>(job_ + 1);
  const bool moves = running() && source > 0;
  const MotionLine shown = moves ? MotionLine::of(source) : MotionLine{line_job_, line_};
  report.line = shown.line;
  report.cycles = cycles_;
  report.name = job_ >= 0 ? job_of(job_).name.c_str() : "";
  report.called = job_ >= 0 && shown.job >= 0 ? job_of(shown.job).name.c_str() : report.name;
  report.message = message_;
  return report;
}

void JobRunner::step(double seconds, Signals& signals, MotionPort& port) noexcept {
  const PathPlace place = port.place();
  if (!interrupts_.is(Interrupts::Phase::Leaving) || place.ticket != 0) {
    outputs_.step(seconds, place, port.settled(), signals, pulses_);
  }
  if (!running() || serve_interrupts(signals, port)) {
    return;
  }
  bool first = true;
  for (int left = kStepsPerPeriod; left > 0 && running(); first = false) {
    const Step* step = jobs_.step();
    left -= step == nullptr ? 1 : cost_of(book_, *step);
    Next next = Next::Wait;
    if (step == nullptr) {
      next = leave(port);
    } else if (pauses_.before(jobs_)) {
      if (port.settled()) {
        state_ = JobState::Paused;
        line_ = step->line;
        line_job_ = jobs_.job();
      }
      return;
    } else if (!touches_world(book_, *step) || port.settled()) {
      line_ = step->line;
      line_job_ = jobs_.job();
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

JobRunner::Next JobRunner::leave(MotionPort& port) noexcept {
  if (interrupts_.is(Interrupts::Phase::Running) && jobs_.depth() == interrupted_.depth + 1) {
    return leave_interrupt(port);
  }
  if (jobs_.depth() > 0) {
    jobs_.return_to(jobs_.depth() - 1);
    return Next::Go;
  }
  if (port.settled()) {
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
      return move(step, signals, port);
    case Op::WaitUntil:
      next = wait_until(step, seconds, signals);
      break;
    case Op::WaitTime:
      next = wait_time(step, seconds);
      break;
    case Op::Call:
      return call(step, signals);
    case Op::Arm:
    case Op::Disarm:
      arm(step, signals);
      break;
    case Op::Return:
      jobs_.leave();
      return Next::Go;
    case Op::Speed:
    case Op::Zone:
    case Op::Acceleration:
      settings_.apply(step);
      break;
    case Op::SetOnPath:
      next = set_on_path(step, signals);
      break;
    case Op::Tool:
    case Op::Load:
      next = select(step, port);
      break;
    case Op::Set:
    case Op::Assign:
      next = set(step, signals);
      break;
    case Op::Try:
    case Op::Recover:
      break;
    case Op::Goto:
      jobs_.jump(step.index);
      return Next::Go;
    case Op::If:
    case Op::Unless:
      return branch(step, signals);
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

JobRunner::Next JobRunner::select(const Step& step, MotionPort& port) noexcept {
  if (!(step.op == Op::Tool ? port.take_tool(step.index) : port.take_load(step.index))) {
    return Next::Wait;
  }
  settings_.apply(step);
  return Next::Go;
}

bool JobRunner::shift(const Step& step, Signals& signals, Target& target) noexcept {
  Vec3 offset;
  for (int i = 0; i < kOffsets; ++i) {
    if (!compute(step.formula + i, signals, offset[i])) {
      return false;
    }
  }
  const Quat axes = step.by_tool          ? target.pose.orientation
                    : step.index == kBack ? Quat::Identity()
                                          : book_.points[static_cast<std::size_t>(step.index)].axes;
  target.pose.position += axes * offset / 1000;
  target.known = nullptr;
  return true;
}

JobRunner::Next JobRunner::move(const Step& step, Signals& signals, MotionPort& port) noexcept {
  if (!port.ready()) {
    return Next::Wait;
  }
  if (in_job_ && (step.move == Move::Circle || step.move == Move::Spline)) {
    refuse({ErrorCode::Line}, "a job cannot begin with a circle or a spline; begin with the motion before it");
    return Next::Wait;
  }
  in_job_ = false;
  MoveCommand command;
  command.move = step.move;
  if (step.index == kBack && port.left_at() == nullptr) {
    refuse({ErrorCode::Line}, "BACK is where an interrupt left the path; there is none, this job was not called by ON");
    return Next::Wait;
  }
  if (step.index == kBack) {
    command.target.joints = *port.left_at();
    command.target.is_pose = step.formula >= 0;
    command.target.pose = port.tip_at(command.target.joints);
  } else {
    command.target = book_.target(step.index, settings_.tool);
  }
  if (step.formula >= 0 && !shift(step, signals, command.target)) {
    return Next::Wait;
  }
  if (step.mid >= 0) {
    command.mid = book_.target(step.mid, settings_.tool);
  }
  command.speed = settings_.speed;
  command.tool_speed = step.move == Move::Joint ? 0 : settings_.tool_speed;
  command.zone = settings_.zone;
  command.acceleration = settings_.acceleration;
  command.straight = step.move == Move::Joint && step.value != 0;
  command.more = step.move == Move::Spline && step.value != 0;
  command.source = MotionLine{jobs_.job(), step.line}.source();
  const auto following = static_cast<std::size_t>(jobs_.index()) + 1;
  command.alone = following < jobs_.steps().size() && jobs_.steps()[following].op == Op::SetOnPath;
  command.ticket = ++ticket_;
  if (const Fault fault = port.move(command); !fault.ok()) {
    fail(fault, to_string(fault.code), command.source);
    return Next::Wait;
  }
  jobs_.advance();
  return Next::Go;
}

JobRunner::Next JobRunner::set(const Step& step, Signals& signals) noexcept {
  if (step.pulse > 0) {
    return pulses_.start(static_cast<std::size_t>(step.index), step.pulse, signals) ? Next::Go : Next::Wait;
  }
  double value = 0;
  if (!compute(step.formula, signals, value)) {
    return Next::Wait;
  }
  const auto index = static_cast<std::size_t>(step.index);
  if (step.op == Op::Assign) {
    jobs_.variables()[index] = value;
  } else {
    pulses_.forget(index);
    signals.write(index, value);
  }
  return Next::Go;
}

JobRunner::Next JobRunner::branch(const Step& step, Signals& signals) noexcept {
  double value = 0;
  if (!compute(step.formula, signals, value)) {
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

JobRunner::Next JobRunner::wait_until(const Step& step, double seconds, Signals& signals) noexcept {
  double value = 0;
  if (!compute(step.formula, signals, value)) {
    return Next::Wait;
  }
  if (value != 0) {
    return Next::Go;
  }
  state_ = JobState::Waits;
  waited_ += seconds;
  if (step.timeout > 0 && waited_ >= step.timeout) {
    refuse({ErrorCode::Line}, "waited in vain");
  }
  return Next::Wait;
}

JobRunner::Next JobRunner::wait_time(const Step& step, double seconds) noexcept {
  // The period in which the wait begins is not counted, so that a wait is never shorter than written.
  waited_ += state_ == JobState::Waits ? seconds : 0;
  state_ = JobState::Waits;
  constexpr double kRounding = 1e-9;
  return waited_ + kRounding >= step.value ? Next::Go : Next::Wait;
}

JobRunner::Next JobRunner::call(const Step& step, Signals& signals) noexcept {
  if (jobs_.is_full()) {
    refuse({ErrorCode::Line}, "jobs call each other too deep; does one call itself without end?");
    return Next::Wait;
  }
  CallStack::Variables arguments{};
  for (int i = 0; i < step.mid; ++i) {
    if (!compute(step.formula + i, signals, arguments[static_cast<std::size_t>(i)])) {
      return Next::Wait;
    }
  }
  jobs_.advance();
  jobs_.call(step.index, arguments);
  return Next::Go;
}

JobRunner::Next JobRunner::set_on_path(const Step& step, Signals& signals) noexcept {
  if (outputs_.is_full()) {
    return Next::Wait;
  }
  double value = 0;
  if (step.formula >= 0 && !compute(step.formula, signals, value)) {
    return Next::Wait;
  }
  const bool by_time = step.timeout > 0;
  outputs_.add({step.index, value, ticket_, by_time, step.mid == 1, by_time ? step.timeout : step.value, step.pulse});
  return Next::Go;
}

void JobRunner::arm(const Step& step, Signals& signals) noexcept {
  if (step.op == Op::Arm) {
    interrupts_.arm(step.slot, signals);
  } else {
    interrupts_.disarm(step.index);
  }
}

}  // namespace indurop::robot
