// SPDX-License-Identifier: Apache-2.0
// From a version that is ready to the end of its health window: the exchange between two runs, and the way back.
#include <algorithm>
#include <utility>

#include "core/base/duration.h"
#include "core/rt/clock.h"
#include "core/rt/copy_text.h"
#include "node/exchange/module_exchange.h"
#include "node/exchange/schedule_change.h"
#include "node/exchange/version_text.h"
#include "store/operate/journal.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::Exchange;
using scheduler::ModuleState;
using scheduler::VersionState;

constexpr std::chrono::seconds kNoGapFound{5};  // in addition to two periods
constexpr int kCopiesInOneGo = 20;
constexpr const char* kPreviousRuns = "the previous one, runs again";

std::string numbers_of(const operate::ReloadReport& report) {
  return fmt::format(
      ": {} bytes kept, {} ticks left out, {} ns of copying, its first run ended {} us after its release",
      report.plan.with_state ? report.plan.bytes : 0, report.left_out, report.copying_ns, report.response_ns / 1000);
}

}  // namespace

void ModuleExchange::watch(std::uint64_t tick) {
  Exchange::Settings settings;
  settings.next = {other_.functions().run, other_.functions().condition};
  settings.pairs = carry_.pairs;
  settings.offered = carry_.between_runs;
  settings.can_return = !carry_.between_runs && !back_;
  settings.earliest_tick = tick;
  if (!variables_.prepare(context_.parts.store, settings)) {
    return abort("there is no memory for the variables whose types change");
  }
  saved_.resize(carry_.between_runs ? running().memory().most() : 0);
  exchange_ = std::make_unique<Exchange>(std::move(settings));
  skipped_before_ = record().skipped.load();
  overruns_before_ = record().overruns.load();
  const std::chrono::nanoseconds period(record().period_ns);
  const scheduler::RunBlock& run = context_.parts.run;
  const std::uint64_t next = run.tick.load();
  const auto ahead = static_cast<std::int64_t>(tick > next ? tick - next : 0);
  deadline_ =
      context_.parts.store.now() + kNoGapFound + 2 * period + std::chrono::nanoseconds(ahead * run.basic_period_ns);
  step_ = Step::Waiting;
  context_.offer_to_track(module_, other_);
  if (!context_.parts.engine.watch(module_, *exchange_)) {
    abort("the version that runs has faulted or was stopped meanwhile");
  }
}

void ModuleExchange::wait_for_exchange() {
  if (exchange_->step() != Exchange::Step::Waiting) {
    note_exchanged();
  } else if (record().state.load() != ModuleState::Running) {
    abort("the version that runs has faulted or was stopped meanwhile");
  } else if (const std::string forced = variables_.forced(context_.parts.store); !forced.empty()) {
    abort(fmt::format("variable {}, whose type changes, was forced meanwhile: release it (indurop unforce)", forced));
  } else if (context_.parts.store.now() > deadline_) {
    abort(
        !carry_.between_runs ? "it was not entered, so there was no moment between two runs"
        : variables_.changes_types()
            ? "its runs leave too little time between them to copy what it keeps, or a variable whose type changes is "
              "written all the time"
            : "its runs leave too little time between them to copy what it keeps");
  } else if (carry_.between_runs && context_.parts.engine.has_passed(module_)) {
    offer_copy();
  }
}

void ModuleExchange::offer_copy() {
  for (int i = 0; i < kCopiesInOneGo; ++i) {
    const auto gap = exchange_->gap();
    if (!gap || (exchange_->is_offered(*gap) && !exchange_->withdraw(*gap))) {
      continue;
    }
    exchange_->note_versions();
    const bool keeps = report_.plan.with_state;
    const std::size_t bytes = keeps ? running().memory().save(saved_) : 0;
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(saved_.data());
    if ((keeps && bytes == 0) || !exchange_->is_still_in(*gap)) {
      continue;
    }
    if (keeps) {
      (void)other_.memory().restore(running().memory().form(), {begin, bytes});
    }
    if (const std::string why = variables_.carry(context_.parts.store, back_ || request_.lossy); !why.empty()) {
      return abort(why);
    }
    saved_bytes_ = bytes;
    exchange_->offer(*gap);
    return;
  }
}

void ModuleExchange::note_exchanged() {
  variables_.follow(context_.parts.store);
  std::swap(running(), other_);
  exchanged_ = true;
  report_.tick = exchange_->first_tick();
  report_.left_out = record().skipped.load() - skipped_before_;
  report_.copying_ns = exchange_->copying_ns();
  report_.response_ns = exchange_->response_ns();
  const bool watched = !back_ && (held_ || request_.health_ns > 0);
  if (back_) {
    report_return(reason_, running().digest(), kPreviousRuns);
  } else {
    set_version(watched ? VersionState::Watched : VersionState::Settled, running().digest());
    context_.parts.console.info("module {}: version {} ({}) runs since tick {}{}", record().name,
                                record().version.load(), short_digest(running().digest()), report_.tick,
                                numbers_of(report_));
    answer(CommandResult::Done,
           report_.plan.with_state ? "exchanged, with what it keeps" : "exchanged, with initial values");
  }
  step_ = Step::Watched;
  deadline_ = held_ ? rt::MonoTime::max() : context_.parts.store.now() + std::chrono::nanoseconds(request_.health_ns);
  if (!watched) {
    leave();
  }
}

void ModuleExchange::check_health() {
  const Exchange::Step step = exchange_->step();
  if (step == Exchange::Step::Back) {
    note_returned();
  } else if (step != Exchange::Step::Done) {
    return;  // the next run is one of the previous version
  } else if (record().state.load() == ModuleState::Faulted && (saved_bytes_ > 0 || variables_.changes_types())) {
    return_closed();
  } else if (record().state.load() != ModuleState::Running) {
    leave();  // stopped by command
  } else if (guard_ && !guard_->holds(context_.parts.store)) {
    if (!exchange_->go_back(Exchange::Reason::Guard)) {
      then_back_ = Exchange::Reason::Guard;
      leave();
    }
  } else if (carry_.between_runs && record().overruns.load() > overruns_before_) {
    then_back_ = Exchange::Reason::Overrun;
    leave();
  } else if (context_.parts.store.now() >= deadline_) {
    record().version_state.store(VersionState::Settled);
    leave();
  } else {
    save_for_return();
  }
}

// What a normal thread copies is not there at the moment of a fault: the newest copy is.
void ModuleExchange::save_for_return() {
  const auto gap = carry_.between_runs && report_.plan.with_state ? exchange_->gap() : std::nullopt;
  std::vector<std::byte> now(gap ? running().memory().most() : 0);
  const std::size_t bytes = gap ? running().memory().save(now) : 0;
  if (bytes > 0 && exchange_->is_still_in(*gap)) {
    saved_ = std::move(now);
    saved_bytes_ = bytes;
  }
}

void ModuleExchange::note_returned() {
  std::swap(running(), other_);
  exchanged_ = false;
  const Exchange::Reason reason = exchange_->reason();
  other_is_unsound_ = reason == Exchange::Reason::Fault;
  report_.tick = exchange_->first_tick();
  report_.left_out = record().skipped.load() - skipped_before_ + (other_is_unsound_ ? 1 : 0);
  report_return(reason, running().digest(), kPreviousRuns);
  leave();
}

// The module is stopped by a fault, and the thread that runs it could not continue alone.
void ModuleExchange::return_closed() {
  if (!context_.parts.engine.at_rest(module_)) {
    return;
  }
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(saved_.data());
  if (saved_bytes_ > 0) {
    (void)other_.memory().restore(running().memory().form(), {begin, saved_bytes_});
  }
  if (const std::string why =
          VariableChange::back_to(context_.parts.store, other_.uses()).change_at_once(context_.parts.store, true);
      !why.empty()) {
    context_.parts.console.warning("module {}: {}", record().name, why);
    return leave();
  }
  context_.parts.engine.replace_closed(module_, {other_.functions().run, other_.functions().condition});
  std::swap(running(), other_);
  context_.set_on_track(module_, running());
  exchanged_ = false;
  other_is_unsound_ = true;
  record().state.store(ModuleState::Running);
  context_.parts.engine.enable(module_);
  report_.tick = context_.parts.run.tick.load();
  report_return(Exchange::Reason::Fault, running().digest(), kPreviousRuns);
  leave();
}

// A version that goes back at this moment does so first.
void ModuleExchange::leave() {
  const Exchange::Step step = exchange_->settle();
  if (step == Exchange::Step::Back && exchanged_) {
    note_returned();
  } else if (step != Exchange::Step::GoingBack && step != Exchange::Step::Failing) {
    (void)context_.parts.engine.unwatch(module_);
    step_ = Step::Leaving;
  }
}

// No run asks the exchange any more, so its step is the last one.
void ModuleExchange::has_left() {
  if (exchange_->step() == Exchange::Step::Waiting) {
    answer(CommandResult::Failed, failure_);
  } else if (!failure_.empty() && !exchanged_) {
    note_exchanged();  // it came after the decision to give it up
  }
  const bool goes_back = runs_new() && then_back_.has_value();
  discard_other();
  step_ = Step::Over;
  if (goes_back && record().state.load() == ModuleState::Running) {
    begin_back(*then_back_);
  }
}

// After an exchange the previous version stays ready; whatever else does not run is ended.
void ModuleExchange::discard_other() {
  if (exchanged_ && !back_) {
    if (auto older = context_.previous.extract(module_); !older.empty()) {
      context_.retired.add(module_, std::move(older.mapped()));
    }
    context_.previous.emplace(module_, std::move(other_));
  } else if (back_ && !exchanged_) {
    context_.previous.emplace(module_, std::move(other_));
  } else if (other_is_unsound_) {
    context_.retired.abandon(module_, std::move(other_));
  } else {
    context_.retired.add(module_, std::move(other_));
  }
}

void ModuleExchange::abort(const std::string& why) {
  if (step_ == Step::Waiting) {
    failure_ = why;
    leave();
    return;
  }
  answer(CommandResult::Failed, why);
  discard_other();
  step_ = Step::Over;
}

void ModuleExchange::end() {
  if (is_over()) {
    return;
  }
  const bool prepared = end_preparation();
  const bool runs =
      exchange_ != nullptr && exchange_->step() != Exchange::Step::Waiting && exchange_->step() != Exchange::Step::Back;
  if (runs) {
    variables_.follow(context_.parts.store);  // what is retained is saved after this
  }
  if (runs != exchanged_) {
    std::swap(running(), other_);  // stop() of the version that ran last is called with the others
    exchanged_ = runs;
  }
  answer(CommandResult::Ending, "the node ends");
  if (prepared) {
    discard_other();
  }
  step_ = Step::Over;
}

}  // namespace indurop::node
