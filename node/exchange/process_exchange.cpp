// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/process_exchange.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/carry.h"
#include "node/exchange/version_text.h"
#include "node/modules/kept_versions.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::Exchange;
using scheduler::ModuleState;
using scheduler::VersionState;

constexpr std::chrono::seconds kStartLimit{10};  // until the new process calls irp::waitPeriod()
constexpr std::chrono::seconds kFollowLimit{5};  // in addition to two periods
constexpr std::chrono::milliseconds kAsked{500};
constexpr std::chrono::seconds kGrace{2};
constexpr std::chrono::milliseconds kPoll{1};
constexpr const char* kRunsNoMore = "the process that runs has faulted or was stopped meanwhile";

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
  const Candidate candidate = preparation_->take();
  preparation_.reset();
  if (is_given_up_) {
    answer(CommandResult::Failed, kGivenUp);
    step_ = Step::Over;
  } else if (is_wanted(candidate)) {
    note_not_kept(candidate);
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
    answer(CommandResult::Done, "would be exchanged; only a process of the new version tells what is carried");
  } else {
    return true;
  }
  return false;
}

void ProcessExchange::launch() {
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
    abort(kRunsNoMore, now);
  } else if (slot().ready.load(std::memory_order_acquire) == other_.pid) {
    compare(now);
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
  if (carry.loses && !request_.lossy) {
    answer(CommandResult::Refused, "values would be lost; --lossy exchanges it nevertheless");
    leave(now);
  } else {
    follow_from_ = held_ ? kNotYet : next_macro_period(context_);
    step_ = Step::Ready;
  }
}

void ProcessExchange::let_follow(rt::MonoTime now) {
  if (has_ended(other_)) {
    abort(describe_end(other_.status), now);
  } else if (record().state.load() != ModuleState::Running) {
    abort(kRunsNoMore, now);
  } else if (follow_from_ != kNotYet) {
    const scheduler::RunBlock& run = context_.parts.run;
    const std::uint64_t next = run.tick.load();
    const auto ahead = static_cast<std::int64_t>(follow_from_ > next ? follow_from_ - next : 0);
    skipped_before_ = record().skipped.load();
    overruns_before_ = record().overruns.load();
    deadline_ = now + kFollowLimit + std::chrono::nanoseconds(2 * record().period_ns + ahead * run.basic_period_ns);
    processes_.hold(module_, true);
    slot().previous.store(processes_.pid(module_), std::memory_order_release);
    slot().version.store(other_.program.version);
    slot().follow_from.store(follow_from_);
    slot().may_follow.store(other_.pid, std::memory_order_release);
    slot().turn.wake();
    slot().wake.wake();  // the other one may have executed its last run
    step_ = Step::Following;
  }
}

// Whether it has begun its first run, or should have.
bool ProcessExchange::has_run() const noexcept {
  const scheduler::RunBlock& run = context_.parts.run;
  const auto period = static_cast<std::uint64_t>(record().period_ns / run.basic_period_ns);
  const std::uint64_t tick = run.tick.load();
  return tick > follow_from_ && (period == 0 || slot().runner.load() == other_.pid || tick > follow_from_ + period);
}

void ProcessExchange::await_follow(rt::MonoTime now) {
  if (slot().followed.load(std::memory_order_acquire) == other_.pid) {
    if (has_run()) {
      note_exchanged(now);
    }
  } else if (has_ended(other_) || now > deadline_) {
    withdraw(other_.pid > 0 ? "the run of the process before it does not end" : describe_end(other_.status), now);
  }
}

void ProcessExchange::withdraw(const std::string& why, rt::MonoTime now) {
  slot().version.store(running_.version);
  slot().follow_from.store(0);
  slot().may_follow.store(processes_.pid(module_));
  slot().recall.wake();
  abort(why, now);
}

void ProcessExchange::swap() {
  const pid_t former = processes_.pid(module_);
  running_ = other_.program;
  other_ = {former, 0, processes_.replace(module_, other_.pid, running_)};
}

// If the process that runs dies, it is started again with the same program, although its file may have been replaced by
// that of the version that failed.
void ProcessExchange::keep_running_file() {
  const auto same =
      find_version_file(context_.parts.node, running_.digest, {running_.file}, running_.file.parent_path());
  if (same) {
    running_.file = *same;
    (void)processes_.set_program(module_, running_);
  }
}

void ProcessExchange::note_exchanged(rt::MonoTime now) {
  swap();
  runs_new_ = true;
  slot().successor.store(0);
  report_.tick = std::max(follow_from_, slot().follow_tick.load() + 1);
  report_.left_out = record().skipped.load() - skipped_before_;
  const std::int64_t two_periods = 2 * record().period_ns / context_.parts.run.basic_period_ns;
  judged_from_ = report_.tick + static_cast<std::uint64_t>(two_periods) + 1;
  set_version(is_judged() ? VersionState::Watched : VersionState::Settled, running_.digest);
  context_.parts.console.info("module {}: version {} ({}) is process {}, since tick {}: {} runs left out",
                              record().name, record().version.load(), short_digest(running_.digest),
                              processes_.pid(module_), report_.tick, report_.left_out);
  answer(CommandResult::Done,
         report_.plan.with_state ? "exchanged, with what it keeps" : "exchanged, with initial values");
  deadline_ = held_ ? rt::MonoTime::max() : now + std::chrono::nanoseconds(request_.health_ns);
  step_ = Step::Watched;
}

std::optional<Exchange::Reason> ProcessExchange::fault() const {
  if (record().state.load() != ModuleState::Running) {
    return Exchange::Reason::Fault;
  }
  if (guard_ && !guard_->holds(context_.parts.store)) {
    return Exchange::Reason::Guard;
  }
  if (record().overruns.load() > overruns_before_ && is_judged()) {
    return Exchange::Reason::Overrun;
  }
  return std::nullopt;
}

void ProcessExchange::check_health(rt::MonoTime now) {
  if (context_.parts.run.tick.load() < judged_from_) {
    overruns_before_ = record().overruns.load();  // a run that was late because of the exchange
  }
  const bool only_this_one = has_ended(other_) || record().state.load() == ModuleState::Stopped;
  const auto reason = fault();
  if (reason && !only_this_one) {
    go_back(*reason, now);
  } else if (only_this_one || now >= deadline_) {
    record().version_state.store(VersionState::Settled);
    leave(now);
  }
}

void ProcessExchange::settle() {
  if (step_ == Step::Watched) {
    record().version_state.store(VersionState::Settled);
    leave(rt::MonoClock::now());
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

void ProcessExchange::go_back(Exchange::Reason reason, rt::MonoTime now) {
  reason_ = reason;
  deadline_ = now + kFollowLimit;
  skipped_before_ = record().skipped.load();
  slot().successor.store(other_.pid);  // first, because it waits as the previous one until then
  slot().previous.store(std::max(processes_.pid(module_), 0));
  slot().version.store(other_.program.version);
  slot().follow_from.store(0);
  slot().may_follow.store(other_.pid);
  slot().recall.wake();
  step_ = Step::Returning;
}

void ProcessExchange::await_return(rt::MonoTime now) {
  if (slot().followed.load(std::memory_order_acquire) == other_.pid) {
    swap();
    keep_running_file();
    report_.tick = slot().follow_tick.load() + 1;
    report_.left_out = record().skipped.load() - skipped_before_;
    runs_new_ = false;
    report_return(reason_, running_.digest,
                  fmt::format("the previous one, is process {} again", processes_.pid(module_)));
    leave(now);
  } else if (has_ended(other_) || now > deadline_) {
    const std::string why = other_.pid > 0 ? "it does not follow" : describe_end(other_.status);
    context_.parts.console.warning("module {}: the previous process cannot run again: {}", record().name, why);
    answer(CommandResult::Failed, "the previous process cannot run again: " + why);
    record().version_state.store(VersionState::Settled);
    leave(now);
  }
}

void ProcessExchange::leave(rt::MonoTime now) {
  slot().successor.store(0);
  slot().previous.store(0);
  slot().turn.wake();
  slot().recall.wake();
  processes_.hold(module_, false);
  deadline_ = now + kGrace;
  was_asked_ = false;
  step_ = Step::Ending;
}

void ProcessExchange::await_end(rt::MonoTime now) {
  if (has_ended(other_)) {
    step_ = Step::Over;
  } else if (now > deadline_) {
    context_.parts.console.warning("module {}: process {} did not end within {} s and was killed", record().name,
                                   other_.pid, kGrace.count());
    ::kill(other_.pid, SIGKILL);
    deadline_ = rt::MonoTime::max();
  } else if (now > deadline_ - kGrace + kAsked && !std::exchange(was_asked_, true)) {
    ::kill(other_.pid, SIGTERM);  // it does not wait for its turn
  }
}

void ProcessExchange::abort(const std::string& why, rt::MonoTime now) {
  answer(CommandResult::Failed, why);
  leave(now);
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
    rt::sleep_until(rt::MonoClock::now() + kPoll);
  }
}

}  // namespace indurop::node
