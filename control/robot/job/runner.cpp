// SPDX-License-Identifier: Apache-2.0
#include "control/robot/job/runner.h"

#include <algorithm>
#include <cmath>

namespace indurop::robot {

namespace {

constexpr int kStepsPerPeriod = 64;  // an endless loop without waiting continues in the next period
constexpr int kPartsPerStep = 4;     // of formulas; a longer formula counts as several steps
constexpr int kOffsets = 3;          // x, y, z

}  // namespace

std::span<const Formula> JobRunner::formulas_of(const Step& step) const noexcept {
  if (step.formula < 0) {
    return {};
  }
  const auto first = static_cast<std::size_t>(step.formula);
  switch (step.op) {
    case Op::Call:
      return std::span(book_.formulas).subspan(first, static_cast<std::size_t>(step.mid));
    case Op::Move:
      return std::span(book_.formulas).subspan(first, kOffsets);
    default:
      return std::span(book_.formulas).subspan(first, 1);
  }
}

bool JobRunner::touches_world(const Step& step) const noexcept {
  const auto formulas = formulas_of(step);
  return step.op == Op::Set || step.op == Op::WaitUntil || step.op == Op::WaitTime || step.op == Op::Tool ||
         step.op == Op::Load || step.op == Op::Arm || step.op == Op::Disarm || step.op == Op::Try ||
         step.op == Op::EndTry || step.op == Op::Recover ||
         std::any_of(formulas.begin(), formulas.end(), [](const Formula& each) { return each.looks_out(); });
}

int JobRunner::cost_of(const Step& step) const noexcept {
  int parts = 0;
  for (const Formula& formula : formulas_of(step)) {
    parts += static_cast<int>(formula.size());
  }
  return 1 + parts / kPartsPerStep;
}

bool JobRunner::compute(int formula, Signals& signals, double& value) noexcept {
  value = book_.formulas[static_cast<std::size_t>(formula)].value(frame().variables, signals);
  if (std::isnan(value)) {
    refuse({ErrorCode::Line}, "this has no value; is there a division by 0?");
  }
  return !std::isnan(value);
}

void JobRunner::modal(const Step& step) noexcept {
  if (step.op == Op::Zone) {
    modal_.zone = step.value;
    return;
  }
  if (step.op == Op::Acceleration) {
    modal_.acceleration = step.value;
    return;
  }
  if (step.index == 1) {
    modal_.tool_speed = step.value;
  } else {
    modal_.speed = step.value;
    modal_.tool_speed = 0;
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
  const int called = moves ? source >> kLineBits : line_job_;
  report.line = moves ? line_of(source) : line_;
  report.cycles = cycles_;
  report.name = job_ >= 0 ? job_of(job_).name.c_str() : "";
  report.called = job_ >= 0 && called >= 0 ? job_of(called).name.c_str() : report.name;
  report.message = message_;
  return report;
}

const Step* JobRunner::present() const noexcept {
  const auto& steps = job_of(frame().job).steps;
  const auto at = static_cast<std::size_t>(frame().step);
  return at < steps.size() ? &steps[at] : nullptr;
}

void JobRunner::step(double seconds, Signals& signals, MotionPort& port) noexcept {
  if (serving_ != Serving::Leaving || port.place().ticket != 0) {
    fire(seconds, signals, port);
  }
  if (!running() || interrupt(signals, port)) {
    return;
  }
  bool first = true;
  for (int left = kStepsPerPeriod; left > 0 && running(); first = false) {
    const Step* step = present();
    left -= step == nullptr ? 1 : cost_of(*step);
    Next next = Next::Wait;
    if (step == nullptr) {
      next = leave(port);
    } else if (pauses_before(*step)) {
      if (port.settled()) {
        state_ = JobState::Paused;
        line_ = step->line;
        line_job_ = frame().job;
      }
      return;
    } else if (!touches_world(*step) || port.settled()) {
      line_ = step->line;
      line_job_ = frame().job;
      last_job_ = frame().job;
      last_step_ = frame().step;
      next = run(*step, first ? seconds : 0, signals, port);
    }
    if (next == Next::Wait) {
      return;
    }
    waited_ = 0;
    free_ = false;
    state_ = running() ? JobState::Runs : state_;
  }
}

JobRunner::Next JobRunner::leave(MotionPort& port) noexcept {
  if (serving_ == Serving::Runs && depth_ == interrupted_.depth + 1) {
    return leave_interrupt(port);
  }
  if (depth_ > 0) {
    --depth_;
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
      next = arm(step, signals);
      break;
    case Op::Return:
      frame().step = static_cast<int>(job_of(frame().job).steps.size());
      return Next::Go;
    case Op::Speed:
    case Op::Zone:
    case Op::Acceleration:
      modal(step);
      break;
    case Op::SetOnPath:
      next = set_on_path(step, signals);
      break;
    case Op::Tool:
    case Op::Load:
      next = hold(step, port);
      break;
    case Op::Set:
    case Op::Assign:
      next = step.pulse > 0 ? pulse(step, signals) : assign(step, signals);
      break;
    case Op::Try:
    case Op::Recover:
      break;
    case Op::Goto:
      jump(step.index);
      return Next::Go;
    case Op::If:
    case Op::Unless:
      return branch(step, signals);
    case Op::Again:
    case Op::EndTry:
      frame().step = step.index;
      return Next::Go;
    case Op::Loop:
      loop(step);
      break;
    case Op::End:
      end_loop(step);
      return Next::Go;
  }
  frame().step += next == Next::Go ? 1 : 0;
  return next;
}

JobRunner::Next JobRunner::hold(const Step& step, MotionPort& port) noexcept {
  if (!(step.op == Op::Tool ? port.take_tool(step.index) : port.take_load(step.index))) {
    return Next::Wait;
  }
  tool_ = step.op == Op::Tool ? step.index : tool_;
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
    command.target = book_.target(step.index, tool_);
  }
  if (step.formula >= 0 && !shift(step, signals, command.target)) {
    return Next::Wait;
  }
  if (step.mid >= 0) {
    command.mid = book_.target(step.mid, tool_);
  }
  command.speed = modal_.speed;
  command.tool_speed = step.move == Move::Joint ? 0 : modal_.tool_speed;
  command.zone = modal_.zone;
  command.acceleration = modal_.acceleration;
  command.straight = step.move == Move::Joint && step.value != 0;
  command.more = step.move == Move::Spline && step.value != 0;
  command.source = frame().job << kLineBits | static_cast<int>(step.line);
  const auto& steps = job_of(frame().job).steps;
  const auto behind = static_cast<std::size_t>(frame().step) + 1;
  command.alone = behind < steps.size() && steps[behind].op == Op::SetOnPath;
  command.ticket = ++ticket_;
  if (const Fault fault = port.move(command); !fault.ok()) {
    fail(fault, to_string(fault.code), command.source);
    return Next::Wait;
  }
  ++frame().step;
  return Next::Go;
}

JobRunner::Next JobRunner::assign(const Step& step, Signals& signals) noexcept {
  double value = 0;
  if (!compute(step.formula, signals, value)) {
    return Next::Wait;
  }
  const auto index = static_cast<std::size_t>(step.index);
  if (step.op == Op::Assign) {
    frame().variables[index] = value;
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
    jump(step.index);
  } else if (step.op == Op::Unless && value == 0) {
    frame().step = step.index;
  } else {
    ++frame().step;
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
  if (depth_ + 1 >= kDeepest) {
    refuse({ErrorCode::Line}, "jobs call each other too deep; does one call itself without end?");
    return Next::Wait;
  }
  Frame called;
  called.job = step.index;
  for (int i = 0; i < step.mid; ++i) {
    if (!compute(step.formula + i, signals, called.variables[static_cast<std::size_t>(i)])) {
      return Next::Wait;
    }
  }
  ++frame().step;
  ++depth_;
  frame() = called;
  return Next::Go;
}

void JobRunner::jump(int step) noexcept {
  Frame& here = frame();
  here.step = step;
  // Loops that do not enclose the label are left; one that is entered from outside runs once.
  const auto& steps = job_of(here.job).steps;
  int open = 0;
  for (int i = 0; i < step; ++i) {
    const Op op = steps[static_cast<std::size_t>(i)].op;
    open += op == Op::Loop ? 1 : op == Op::End ? -1 : 0;
  }
  for (; here.loops < open; ++here.loops) {
    here.left[static_cast<std::size_t>(here.loops)] = 1;
  }
  here.loops = open;
}

void JobRunner::loop(const Step& step) noexcept {
  constexpr double kForEver = 0;
  frame().left[static_cast<std::size_t>(frame().loops++)] = step.value > 0 ? step.value : kForEver;
}

void JobRunner::end_loop(const Step& step) noexcept {
  Frame& here = frame();
  double& left = here.left[static_cast<std::size_t>(here.loops - 1)];
  const bool for_ever = left == 0;
  left -= for_ever ? 0 : 1;
  if (for_ever || left > 0) {
    here.step = step.index + 1;
  } else {
    --here.loops;
    ++here.step;
  }
}

}  // namespace indurop::robot
