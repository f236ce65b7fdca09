// SPDX-License-Identifier: Apache-2.0
// What is commanded, and the process that prepares itself. The rest of the way is in process_exchange_run.cpp.
#include "node/exchange/process_exchange.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <csignal>
#include <cstring>
#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/carry.h"
#include "node/exchange/version_text.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::Exchange;
using scheduler::ModuleState;

constexpr std::chrono::seconds kStartLimit{10};  // until the new process calls irp::waitPeriod()
constexpr std::chrono::milliseconds kProcessPoll{1};

}  // namespace

ProcessExchange::ProcessExchange(ExchangeContext& context, std::uint32_t module, bool held)
    : ProgramExchange(context, module, held, false) {}

void ProcessExchange::go_on(rt::MonoTime now) {
  switch (step_) {
    case Step::Preparing:
      return go_on_checking();
    case Step::Starting:
      return await_ready(now);
    case Step::Ready:
      return let_follow(now);
    case Step::Following:
      return await_follow(now);
    case Step::Watched:
      return check_health(now);
    case Step::Returning:
      return await_return(now);
    case Step::Ending:
      return await_end(now);
    case Step::Over:
      return;
  }
}

void ProcessExchange::go_on_checking() {
  switch (check()) {
    case Progress::Working:
      return;
    case Progress::Answered:
      step_ = Step::Over;
      return;
    case Progress::Ready:
      return launch();
  }
}

bool ProcessExchange::is_wanted(const Candidate& candidate) {
  if (record().state.load() != ModuleState::Running) {
    answer(CommandResult::Refused, "its process does not run, so no other one can follow it");
  } else if (request_.dry_run) {
    report_.plan.compared = false;
    (void)candidate.variables.list(context_.parts.store, report_.plan);
    answer(CommandResult::Done, "would be exchanged; only a process of the new version tells what is carried");
  } else {
    return true;
  }
  return false;
}

void ProcessExchange::launch() {
  running_ = processes_.program(module_);
  other_.program = checked_;
  tape::ProcessKeyframes::remove(context_.parts.node, module_, tape::ProcessKeyframes::Of::Next);
  slot().ready.store(0);
  slot().successor.store(scheduler::kBeingLaunched, std::memory_order_release);
  const auto launched = processes_.launch_next_to(module_, other_.program.file);
  if (!launched) {
    slot().successor.store(0);
    answer(CommandResult::Failed, fmt::format("cannot be started: {}", std::strerror(launched.error().sys_errno)));
    step_ = Step::Over;
    return;
  }
  other_.pid = launched.value();
  slot().successor.store(other_.pid, std::memory_order_release);
  deadline_ = rt::MonoClock::now() + kStartLimit;
  step_ = Step::Starting;
}

bool ProcessExchange::has_ended(Other& other) const {
  if (other.pid > 0 && ::waitpid(other.pid, &other.status, WNOHANG) == other.pid) {
    other.pid = -1;
  }
  return other.pid <= 0;
}

void ProcessExchange::await_ready(rt::MonoTime now) {
  if (has_ended(other_)) {
    abort(describe_end(other_.status) + " before it called irp::waitPeriod()", now);
  } else if (record().state.load() != ModuleState::Running) {
    abort(kProcessRunsNoMore, now);
  } else if (slot().ready.load(std::memory_order_acquire) == other_.pid) {
    if (executes(other_.pid, other_.program.file, other_.program.mark)) {
      compare(now);
    } else {
      abort("its file was replaced while it was started; repeat the command", now);
    }
  } else if (now > deadline_) {
    abort(fmt::format("it has not called irp::waitPeriod() within {} s", kStartLimit.count()), now);
  }
}

// What both processes keep is known now.
void ProcessExchange::compare(rt::MonoTime now) {
  using tape::ProcessKeyframes;
  const auto open = [this](ProcessKeyframes::Of of) {
    return ProcessKeyframes::open(context_.parts.node, module_, context_.parts.run.node_pid.load(), of);
  };
  const auto form_of = [](const Result<ProcessKeyframes>& kept) {
    return kept ? std::optional(kept->form()) : std::nullopt;  // it does not declare it
  };
  const auto next = open(ProcessKeyframes::Of::Next);
  if (next && request_.lossy) {
    next->words().lossy.store(1);
  }
  const Carry carry = plan_carry(form_of(open(ProcessKeyframes::Of::Running)), form_of(next));
  report_.plan = carry.plan;
  (void)variables_.list(context_.parts.store, report_.plan);
  if (carry.loses && !request_.lossy) {
    answer(CommandResult::Refused, "values would be lost; --lossy exchanges it nevertheless");
    leave(now);
  } else {
    follow_from_ = held_ ? kNotYet : next_macro_period(context_);
    step_ = Step::Ready;
  }
}

void ProcessExchange::go_back() {
  const rt::MonoTime now = rt::MonoClock::now();
  switch (step_) {
    case Step::Preparing:
      return give_up();
    case Step::Starting:
    case Step::Ready:
      return abort(kGivenUp, now);
    case Step::Following:
      return withdraw(kGivenUp, now);
    case Step::Watched:
      return go_back(Exchange::Reason::Command, now);
    case Step::Returning:
    case Step::Ending:
    case Step::Over:
      return;
  }
}

void ProcessExchange::end() {
  end_check();
  answer(CommandResult::Ending, "the node ends");
  if (step_ == Step::Over || other_.pid <= 0) {
    step_ = Step::Over;
    return;
  }
  leave(rt::MonoClock::now());
  while (step_ != Step::Over) {
    await_end(rt::MonoClock::now());
    rt::sleep_until(rt::MonoClock::now() + kProcessPoll);
  }
}

}  // namespace indurop::node
