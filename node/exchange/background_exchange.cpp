// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/background_exchange.h"

#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/version_text.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::Exchange;
using scheduler::ModuleState;
using scheduler::VersionState;

constexpr std::chrono::seconds kLeaveLimit{2};

void carry(const ModuleMemory& from, const ModuleMemory& to) {
  std::vector<std::byte> saved(from.most());
  const std::size_t bytes = from.save(saved);
  (void)to.restore(from.form(), {reinterpret_cast<const std::uint8_t*>(saved.data()), bytes});
}

}  // namespace

void BackgroundExchange::go_on(rt::MonoTime now) {
  switch (step_) {
    case Step::Preparing:
      return go_on_preparing(now);
    case Step::Ready:
      return context_.parts.run.tick.load() >= tick_ ? leave(now) : void();
    case Step::Leaving:
      return await_left(now);
    case Step::Watched:
      return check_health(now);
    case Step::Returning:
      return context_.parts.normal_threads.has_ended(module_, now) ? return_previous() : void();
    case Step::Over:
      return;
  }
}

void BackgroundExchange::go_on_preparing(rt::MonoTime now) {
  switch (prepare(now)) {
    case Progress::Working:
      return;
    case Progress::Answered:
      step_ = Step::Over;
      return;
    case Progress::GivenUp:
      return abort(failure_);
    case Progress::Ready:
      break;
  }
  if (!would_run() && held_) {
    return abort(kRunsNoMore);
  }
  tick_ = held_ ? kNotYet : next_macro_period(context_);
  step_ = Step::Ready;
}

void BackgroundExchange::leave(rt::MonoTime now) {
  context_.parts.normal_threads.halt(module_, now);
  deadline_ = now + kLeaveLimit;
  step_ = Step::Leaving;
}

void BackgroundExchange::await_left(rt::MonoTime now) {
  if (failure_.empty() && now > deadline_) {
    failure_ = "its run does not return within 2 s";
  }
  const bool is_given_up = !failure_.empty();
  if (is_given_up && context_.parts.normal_threads.go_on(module_)) {
    return abort(failure_);
  }
  if (!context_.parts.normal_threads.has_left(module_)) {
    return;
  }
  if (!is_given_up) {
    return enter_new(now);
  }
  (void)context_.parts.normal_threads.launch(module_);
  abort(failure_);
}

void BackgroundExchange::enter_new(rt::MonoTime now) {
  const bool runs = would_run();  // else it was stopped, or has faulted
  if (const std::string why = variables_.change_at_once(context_.parts.store, held_ || request_.lossy); !why.empty()) {
    if (runs) {
      (void)context_.parts.normal_threads.launch(module_);
    }
    return abort(why);
  }
  report_.tick = context_.parts.run.tick.load();
  other_is_unsound_ = record().state.load() == ModuleState::Faulted;
  swap(report_.plan.with_state && runs);
  runs_new_ = true;
  const bool is_watched = runs && (held_ || request_.health_ns > 0);
  set_version(is_watched ? VersionState::Watched : VersionState::Settled, running().digest());
  context_.parts.console.info("module {}: version {} ({}) runs in the background", record().name,
                              record().version.load(), short_digest(running().digest()));
  answer(CommandResult::Done, !runs                     ? "is stopped, and begins with this version at `indurop start`"
                              : report_.plan.with_state ? "exchanged, with what it keeps"
                                                        : "exchanged, with initial values");
  deadline_ = held_ ? rt::MonoTime::max() : now + std::chrono::nanoseconds(request_.health_ns);
  step_ = Step::Watched;
  if (!is_watched) {
    discard_other();
  }
}

void BackgroundExchange::swap(bool carries) {
  if (carries) {
    carry(running().memory(), other_.memory());
  }
  const bool runs = would_run();
  std::swap(running(), other_);
  if (runs && !context_.parts.normal_threads.launch(module_)) {
    record().state.store(ModuleState::Stopped);
    context_.parts.console.error("module {}: there is no thread for it; it is stopped", record().name);
  }
}

void BackgroundExchange::check_health(rt::MonoTime now) {
  const ModuleState state = record().state.load();
  if (state == ModuleState::Faulted) {
    go_back(Exchange::Reason::Fault, now);
  } else if (state != ModuleState::Stopped && guard_ && !guard_->holds(context_.parts.store)) {
    go_back(Exchange::Reason::Guard, now);
  } else if (state == ModuleState::Stopped || now >= deadline_) {
    settle();
  }
}

void BackgroundExchange::go_back(Exchange::Reason reason, rt::MonoTime now) {
  reason_ = reason;
  context_.parts.normal_threads.halt(module_, now);
  step_ = Step::Returning;
}

// After a fault, the previous version goes on with what it kept itself.
void BackgroundExchange::return_previous() {
  const bool has_faulted = record().state.load() == ModuleState::Faulted;
  other_is_unsound_ = has_faulted;
  if (const std::string why =
          VariableChange::back_to(context_.parts.store, other_.uses()).change_at_once(context_.parts.store, true);
      !why.empty()) {
    context_.parts.console.warning("module {}: the previous version cannot run again: {}", record().name, why);
    answer(CommandResult::Failed, "the previous version cannot run again: " + why);
    return discard_other();
  }
  record().state.store(ModuleState::Running);
  swap(report_.plan.with_state && !has_faulted);
  runs_new_ = false;
  report_.tick = context_.parts.run.tick.load();
  report_return(reason_, running().digest(), "the previous one, runs again");
  discard_other();
}

void BackgroundExchange::go_back() {
  switch (step_) {
    case Step::Preparing:
    case Step::Leaving:
      failure_ = kGivenUp;
      return;
    case Step::Ready:
      return abort(kGivenUp);
    case Step::Watched:
      return go_back(Exchange::Reason::Command, rt::MonoClock::now());
    case Step::Returning:
    case Step::Over:
      return;
  }
}

void BackgroundExchange::settle() {
  if (step_ == Step::Watched) {
    record().version_state.store(VersionState::Settled);
    discard_other();
  }
}

void BackgroundExchange::abort(const std::string& why) {
  answer(CommandResult::Failed, why);
  discard_other();
}

void BackgroundExchange::discard_other() {
  if (other_is_unsound_) {
    context_.retired.abandon(module_, std::move(other_));
  } else {
    context_.retired.add(module_, std::move(other_));
  }
  step_ = Step::Over;
}

void BackgroundExchange::end() {
  if (step_ == Step::Over) {
    return;
  }
  const bool is_prepared = end_preparation();
  answer(CommandResult::Ending, "the node ends");
  if (is_prepared) {
    discard_other();
  }
  step_ = Step::Over;
}

}  // namespace indurop::node
