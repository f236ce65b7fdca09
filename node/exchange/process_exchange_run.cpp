// SPDX-License-Identifier: Apache-2.0
// From a process that is ready to the end of its health window: it follows, it is watched, and the other one ends.
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/process_exchange.h"
#include "node/exchange/version_text.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::Exchange;
using scheduler::ModuleState;
using scheduler::VersionState;

constexpr std::chrono::seconds kFollowLimit{5};  // in addition to two periods
constexpr std::chrono::milliseconds kProcessAsked{500};
constexpr std::chrono::seconds kProcessEnds{2};

}  // namespace

void ProcessExchange::let_follow(rt::MonoTime now) {
  if (has_ended(other_)) {
    abort(describe_end(other_.status), now);
  } else if (record().state.load() != ModuleState::Running) {
    abort(kProcessRunsNoMore, now);
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
  swap_uses();
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
    find_kept(running_);  // if it dies, it is started again with the same program
    (void)processes_.set_program(module_, running_);
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
  deadline_ = now + kProcessEnds;
  was_asked_ = false;
  step_ = Step::Ending;
}

void ProcessExchange::await_end(rt::MonoTime now) {
  if (has_ended(other_)) {
    step_ = Step::Over;
  } else if (now > deadline_) {
    context_.parts.console.warning("module {}: process {} did not end within {} s and was killed", record().name,
                                   other_.pid, kProcessEnds.count());
    ::kill(other_.pid, SIGKILL);
    deadline_ = rt::MonoTime::max();
  } else if (now > deadline_ - kProcessEnds + kProcessAsked && !std::exchange(was_asked_, true)) {
    ::kill(other_.pid, SIGTERM);  // it does not wait for its turn
  }
}

void ProcessExchange::abort(const std::string& why, rt::MonoTime now) {
  answer(CommandResult::Failed, why);
  leave(now);
}

}  // namespace indurop::node
