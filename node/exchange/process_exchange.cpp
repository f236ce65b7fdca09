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
    : VersionExchange(context, module, held), processes_(context.parts.processes) {}

void ProcessExchange::begin(const operate::ReloadRequest& request) {
  running_ = processes_.program(module_);
  if (!accept(request, running_.digest)) {
    step_ = Step::Over;
    return;
  }
  other_.program.file = request_.file.empty() ? context_.files[module_] : std::filesystem::path(request_.file);
  CandidateTask task{context_.parts.config,     module_,
                     other_.program.file,       context_.parts.store,
                     context_.allowed[module_], context_.parts.libraries[module_]};
  task.may_grow = held_ || context_.parts.may_grow;
  if (!request_.dry_run) {
    task.keep_for = context_.parts.node;
    task.process = processes_.pid(module_);
  }
  preparation_ = std::make_unique<CandidateThread>(std::move(task));
}

void ProcessExchange::go_on(rt::MonoTime now) {
  switch (step_) {
    case Step::Preparing:
      return preparation_->is_done() ? prepared() : void();
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

void ProcessExchange::prepared() {
  Candidate candidate = preparation_->take();
  preparation_.reset();
  if (is_given_up_) {
    answer(CommandResult::Failed, kGivenUp);
    step_ = Step::Over;
  } else if (is_wanted(candidate)) {
    note_not_kept(candidate);
    variables_ = std::move(candidate.variables);
    other_uses_ = candidate.library.uses();
    other_.program.mark = candidate.mark;
    launch();
  } else {
    step_ = Step::Over;
  }
}

bool ProcessExchange::is_wanted(const Candidate& candidate) {
  report_.errors = candidate.errors;
  report_.needs_restart = candidate.needs_restart;
  report_.to = candidate.digest;
  if (!report_.errors.empty()) {
    answer(CommandResult::Refused, count_errors(report_));
  } else if (report_.from == report_.to) {
    answer(CommandResult::Unchanged, "this version runs already");
  } else if (record().state.load() != ModuleState::Running) {
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
  if (!variables_.let_appear(context_.parts.store)) {
    answer(CommandResult::Failed, "another version has brought other variables meanwhile; repeat the command");
    step_ = Step::Over;
    return;
  }
  tape::ProcessKeyframes::remove(context_.parts.node, module_, tape::ProcessKeyframes::Of::Next);
  const auto launched = processes_.launch_next_to(module_, other_.program.file);
  if (!launched) {
    answer(CommandResult::Failed, fmt::format("cannot be started: {}", std::strerror(launched.error().sys_errno)));
    step_ = Step::Over;
    return;
  }
  other_.pid = launched.value();
  other_.program.digest = report_.to;
  if (context_.track_of(module_) != nullptr) {
    const std::string file = std::filesystem::absolute(other_.program.file).string();
    other_.program.version = context_.parts.tape->versions().add(module_, report_.to, file);
    context_.offer_to_track(module_, other_uses_);
  }
  slot().ready.store(0);
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
      is_given_up_ = true;
      return;
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
  if (preparation_ != nullptr) {
    (void)preparation_->take();
  }
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
