// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/restart_exchange.h"

#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/version_text.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::Exchange;
using scheduler::ModuleState;
using scheduler::VersionState;

constexpr std::chrono::seconds kLaunchLimit{5};        // until a process is ready to be released
constexpr std::chrono::milliseconds kFirstCheck{100};  // until then, a program that cannot run at all has ended

}  // namespace

void RestartExchange::go_on(rt::MonoTime now) {
  switch (step_) {
    case Step::Preparing:
      return go_on_checking();
    case Step::Ready:
      return context_.parts.run.tick.load() >= tick_ ? leave(Step::Leaving, now) : void();
    case Step::Leaving:
      return launch_other(Step::Launching, now);
    case Step::Launching:
      return await_new(now);
    case Step::Watched:
      return check_health(now);
    case Step::Returning:
      return launch_other(Step::Relaunching, now);
    case Step::Relaunching:
      return await_previous(now);
    case Step::Over:
      return;
  }
}

void RestartExchange::go_on_checking() {
  switch (check()) {
    case Progress::Working:
      return;
    case Progress::Answered:
      step_ = Step::Over;
      return;
    case Progress::Ready:
      other_ = checked_;
      tick_ = held_ ? kNotYet : next_macro_period(context_);
      step_ = Step::Ready;
  }
}

bool RestartExchange::is_wanted(const Candidate& candidate) {
  report_.plan.why_not = "its process ends before the next one is launched";
  (void)candidate.variables.list(context_.parts.store, report_.plan);
  if (!is_up()) {
    answer(CommandResult::Refused, "its process does not run: `indurop start` launches its new file");
  } else if (!request_.lossy) {
    answer(CommandResult::Refused, "values would be lost; --lossy exchanges it nevertheless");
  } else if (request_.dry_run) {
    answer(CommandResult::Done, "would be exchanged, with initial values");
  } else {
    return true;
  }
  return false;
}

bool RestartExchange::is_down(rt::MonoTime now) const noexcept {
  const ModuleState state = record().state.load();
  return state == ModuleState::Restarting || state == ModuleState::Faulted || now > deadline_;
}

void RestartExchange::leave(Step to, rt::MonoTime now) {
  processes_.hold(module_, true);
  processes_.stop(module_, now);
  step_ = to;
}

void RestartExchange::launch_other(Step to, rt::MonoTime now) {
  if (!processes_.has_ended(module_)) {
    return;
  }
  if (is_given_up_ && to == Step::Launching) {
    to = Step::Relaunching;
  } else {
    other_ = processes_.set_program(module_, std::move(other_));
    swap_uses();
  }
  executes_since_ = now;
  deadline_ = processes_.start(module_) ? now + kLaunchLimit : rt::MonoTime::min();
  step_ = to;
}

void RestartExchange::await_new(rt::MonoTime now) {
  if (is_down(now)) {
    return go_back(Exchange::Reason::Fault, now);
  }
  const Processes::Program& program = processes_.program(module_);
  if (!is_up() || !executes(processes_.pid(module_), program.file, program.mark)) {
    executes_since_ = now;
    return;
  }
  if (now < executes_since_ + kFirstCheck && record().state.load() != ModuleState::Exited) {
    return;
  }
  if (is_given_up_) {
    return go_back(Exchange::Reason::Command, now);
  }
  runs_new_ = true;
  report_.tick = context_.parts.run.tick.load();
  const bool is_watched = held_ || request_.health_ns > 0;
  set_version(is_watched ? VersionState::Watched : VersionState::Settled, report_.to);
  context_.parts.console.info("module {}: version {} ({}) is process {}", record().name, record().version.load(),
                              short_digest(report_.to), processes_.pid(module_));
  answer(CommandResult::Done, "exchanged, with initial values");
  deadline_ = held_ ? rt::MonoTime::max() : now + std::chrono::nanoseconds(request_.health_ns);
  step_ = Step::Watched;
  if (!is_watched) {
    conclude();
  }
}

void RestartExchange::check_health(rt::MonoTime now) {
  const ModuleState state = record().state.load();
  if (state == ModuleState::Restarting || state == ModuleState::Faulted) {
    go_back(Exchange::Reason::Fault, now);
  } else if (state != ModuleState::Stopped && guard_ && !guard_->holds(context_.parts.store)) {
    go_back(Exchange::Reason::Guard, now);
  } else if (state == ModuleState::Stopped || now >= deadline_) {
    settle();
  }
}

void RestartExchange::go_back(Exchange::Reason reason, rt::MonoTime now) {
  reason_ = reason;
  find_kept(other_);
  leave(Step::Returning, now);
}

void RestartExchange::await_previous(rt::MonoTime now) {
  if (is_down(now)) {
    context_.parts.console.warning("module {}: the previous version cannot be launched again", record().name);
    answer(CommandResult::Failed, "neither the new version nor the previous one can be launched");
    return conclude();
  }
  if (!is_up()) {
    return;
  }
  const bool ran = std::exchange(runs_new_, false);
  report_.tick = context_.parts.run.tick.load();
  if (ran) {
    report_return(reason_, report_.from, fmt::format("the previous one, is process {}", processes_.pid(module_)));
  } else {
    answer(CommandResult::Failed,
           is_given_up_ ? kGivenUp : "its process does not run: the previous version was launched again");
  }
  conclude();
}

void RestartExchange::go_back() {
  switch (step_) {
    case Step::Preparing:
      return give_up();
    case Step::Ready:
      answer(CommandResult::Failed, kGivenUp);
      return conclude();
    case Step::Leaving:
    case Step::Launching:
      is_given_up_ = true;
      return;
    case Step::Watched:
      return go_back(Exchange::Reason::Command, rt::MonoClock::now());
    case Step::Returning:
    case Step::Relaunching:
    case Step::Over:
      return;
  }
}

void RestartExchange::settle() {
  if (step_ == Step::Watched) {
    record().version_state.store(VersionState::Settled);
    conclude();
  }
}

void RestartExchange::conclude() {
  processes_.hold(module_, false);
  step_ = Step::Over;
}

void RestartExchange::end() {
  end_check();
  answer(CommandResult::Ending, "the node ends");
  conclude();
}

}  // namespace indurop::node
