// SPDX-License-Identifier: Apache-2.0
// From a version that is ready to the end of its health window: the exchange between two runs, and the way back.
#include <utility>

#include "core/base/duration.h"
#include "core/rt/clock.h"
#include "core/rt/copy_text.h"
#include "node/exchange/exchanges.h"
#include "store/operate/journal.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::Exchange;
using scheduler::ModuleState;
using scheduler::VersionState;

constexpr std::chrono::seconds kNoGapFound{5};  // in addition to two periods
constexpr std::int64_t kLongestGridNs = rt::kNanosPerSecond;
constexpr std::chrono::milliseconds kEndPoll{1};
constexpr int kCopiesInOneGo = 20;
constexpr std::size_t kShownDigits = 12;

// Modules that belong together meet at the beginning of a macro period; a long one is not waited for.
std::uint64_t next_macro_period(const scheduler::RunBlock& run) {
  const std::uint64_t next = run.tick.load();
  return run.macro_period_ns > kLongestGridNs ? next : (next + run.slot_count - 1) / run.slot_count * run.slot_count;
}

std::string short_digest(const std::string& digest) {
  return digest.substr(0, kShownDigits);
}

std::string text_of(Exchange::Reason reason, const scheduler::ModuleRecord& module) {
  switch (reason) {
    case Exchange::Reason::None:
    case Exchange::Reason::Command:
      break;
    case Exchange::Reason::Fault:
      return fmt::format("the new one faulted in tick {}: {}", module.fault_tick.load(), module.last_fault);
    case Exchange::Reason::Overrun:
      return "the new one overran its period";
    case Exchange::Reason::Guard:
      return "the guard did not hold";
  }
  return "by command";
}

}  // namespace

void Exchanges::watch() {
  const Carry& carry = work_->carry;
  Exchange::Settings settings;
  settings.next = {work_->other.functions().run, work_->other.functions().condition};
  settings.pairs = carry.pairs;
  settings.offered = carry.between_runs;
  settings.can_return = !carry.between_runs && !work_->back;
  settings.earliest_tick = next_macro_period(parts_.run);
  work_->saved.resize(carry.between_runs ? running().memory().most() : 0);
  work_->exchange = std::make_unique<Exchange>(std::move(settings));
  work_->skipped_before = record().skipped.load();
  work_->overruns_before = record().overruns.load();
  const std::chrono::nanoseconds period(record().period_ns);
  work_->deadline = parts_.store.now() + kNoGapFound + 2 * period;
  work_->step = Step::Waiting;
  if (!parts_.engine.watch(work_->module, *work_->exchange)) {
    abort("the version that runs has faulted or was stopped meanwhile");
  }
}

void Exchanges::wait_for_exchange() {
  if (work_->exchange->step() != Exchange::Step::Waiting) {
    note_exchanged();
  } else if (record().state.load() != ModuleState::Running) {
    abort("the version that runs has faulted or was stopped meanwhile");
  } else if (parts_.store.now() > work_->deadline) {
    abort(work_->carry.between_runs ? "its runs leave too little time between them to copy what it keeps"
                                    : "it was not entered, so there was no moment between two runs");
  } else if (work_->carry.between_runs && parts_.engine.has_passed(work_->module)) {
    offer_copy();
  }
}

void Exchanges::offer_copy() {
  for (int i = 0; i < kCopiesInOneGo; ++i) {
    const auto gap = work_->exchange->gap();
    if (!gap || work_->exchange->is_offered(*gap)) {
      continue;
    }
    const std::size_t bytes = running().memory().save(work_->saved);
    const auto* const begin = reinterpret_cast<const std::uint8_t*>(work_->saved.data());
    if (bytes > 0 && work_->exchange->is_still_in(*gap)) {
      (void)work_->other.memory().restore(running().memory().form(), {begin, bytes});
      work_->saved_bytes = bytes;
      work_->exchange->offer(*gap);
      return;
    }
  }
}

void Exchanges::note_exchanged() {
  std::swap(running(), work_->other);
  work_->exchanged = true;
  work_->report.tick = work_->exchange->first_tick();
  work_->report.left_out = record().skipped.load() - work_->skipped_before;
  work_->report.copying_ns = work_->exchange->copying_ns();
  work_->report.response_ns = work_->exchange->response_ns();
  const bool watched = work_->request.health_ns > 0;
  if (work_->back) {
    report_return(work_->reason);
  } else {
    set_version(watched ? VersionState::Watched : VersionState::Settled);
    parts_.console.info("module {}: version {} ({}) runs since tick {}{}", record().name, record().version.load(),
                        short_digest(running().digest()), work_->report.tick, numbers());
    answer(CommandResult::Done,
           work_->report.plan.with_state ? "exchanged, with what it keeps" : "exchanged, with initial values");
  }
  work_->step = Step::Watched;
  work_->deadline = parts_.store.now() + std::chrono::nanoseconds(work_->request.health_ns);
  if (!watched) {
    leave();
  }
}

std::string Exchanges::numbers() const {
  const operate::ReloadReport& report = work_->report;
  return fmt::format(
      ": {} bytes kept, {} ticks left out, {} ns of copying, its first run ended {} us after its release",
      report.plan.with_state ? report.plan.bytes : 0, report.left_out, report.copying_ns, report.response_ns / 1000);
}

void Exchanges::check_health() {
  const Exchange::Step step = work_->exchange->step();
  if (step == Exchange::Step::Back) {
    note_returned();
  } else if (step != Exchange::Step::Done) {
    return;  // the next run is one of the previous version
  } else if (record().state.load() == ModuleState::Faulted && work_->saved_bytes > 0) {
    return_closed();
  } else if (record().state.load() != ModuleState::Running) {
    leave();  // stopped by command
  } else if (work_->guard && !work_->guard->holds(parts_.store)) {
    if (!work_->exchange->go_back(Exchange::Reason::Guard)) {
      work_->then_back = Exchange::Reason::Guard;
      leave();
    }
  } else if (work_->carry.between_runs && record().overruns.load() > work_->overruns_before) {
    work_->then_back = Exchange::Reason::Overrun;
    leave();
  } else if (parts_.store.now() >= work_->deadline) {
    record().version_state.store(VersionState::Settled);
    leave();
  } else {
    save_for_return();
  }
}

// What a normal thread copies is not there at the moment of a fault: the newest copy is.
void Exchanges::save_for_return() {
  const auto gap = work_->carry.between_runs ? work_->exchange->gap() : std::nullopt;
  std::vector<std::byte> now(gap ? running().memory().most() : 0);
  const std::size_t bytes = gap ? running().memory().save(now) : 0;
  if (bytes > 0 && work_->exchange->is_still_in(*gap)) {
    work_->saved = std::move(now);
    work_->saved_bytes = bytes;
  }
}

void Exchanges::note_returned() {
  std::swap(running(), work_->other);
  work_->exchanged = false;
  const Exchange::Reason reason = work_->exchange->reason();
  work_->other_is_unsound = reason == Exchange::Reason::Fault;
  work_->report.tick = work_->exchange->first_tick();
  work_->report.left_out = record().skipped.load() - work_->skipped_before + (work_->other_is_unsound ? 1 : 0);
  report_return(reason);
  leave();
}

// The report comes first: a client that sees the version's state reads it.
void Exchanges::report_return(Exchange::Reason reason) {
  const std::string why = text_of(reason, record());
  work_->report.text = "the previous version runs again: " + why;
  work_->report.version = record().version.load() + 1;
  (void)operate::write_report(parts_.node, work_->report);
  if (reason != Exchange::Reason::Command) {  // that one is noted by its client
    operate::note(parts_.node, {rt::to_ns(parts_.store.now()), 0, "the node", "", "reload --back", record().name,
                                "sha256:" + running().digest(), 0, why});
  }
  set_version(VersionState::Returned);
  parts_.console.warning("module {}: version {} ({}), the previous one, runs again since tick {}: {}", record().name,
                         record().version.load(), short_digest(running().digest()), work_->report.tick, why);
  answer(CommandResult::Done, work_->report.text);
}

// The module is stopped by a fault, and the thread that runs it could not continue alone.
void Exchanges::return_closed() {
  if (!parts_.engine.at_rest(work_->module)) {
    return;
  }
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(work_->saved.data());
  (void)work_->other.memory().restore(running().memory().form(), {begin, work_->saved_bytes});
  parts_.engine.replace_closed(work_->module, {work_->other.functions().run, work_->other.functions().condition});
  std::swap(running(), work_->other);
  work_->exchanged = false;
  work_->other_is_unsound = true;
  record().state.store(ModuleState::Running);
  parts_.engine.enable(work_->module);
  work_->report.tick = parts_.run.tick.load();
  report_return(Exchange::Reason::Fault);
  leave();
}

// A version that goes back at this moment does so first.
void Exchanges::leave() {
  const Exchange::Step step = work_->exchange->settle();
  if (step != Exchange::Step::GoingBack && step != Exchange::Step::Failing) {
    (void)parts_.engine.unwatch(work_->module);
    work_->step = Step::Leaving;
  }
}

// No run asks the exchange any more, so its step is the last one.
void Exchanges::has_left() {
  if (work_->exchange->step() == Exchange::Step::Waiting) {
    answer(CommandResult::Failed, work_->failure);
  } else if (!work_->failure.empty() && !work_->exchanged) {
    note_exchanged();  // it came after the decision to give it up
    leave();
  }
  const bool goes_back = work_->exchanged && work_->then_back;
  const std::uint32_t module = work_->module;
  const bool answered = work_->answered;
  const auto reason = work_->then_back.value_or(Exchange::Reason::Command);
  discard_other();
  work_.reset();
  if (goes_back && record(module).state.load() == ModuleState::Running) {
    begin_back(module, answered, reason);
  }
}

// After an exchange the previous version stays ready; whatever else does not run is ended.
void Exchanges::discard_other() {
  if (work_->exchanged && !work_->back) {
    if (auto older = previous_.extract(work_->module); !older.empty()) {
      retired_.add(work_->module, std::move(older.mapped()));
    }
    previous_.emplace(work_->module, std::move(work_->other));
  } else if (work_->back && !work_->exchanged) {
    previous_.emplace(work_->module, std::move(work_->other));
  } else if (work_->other_is_unsound) {
    retired_.abandon(work_->module, std::move(work_->other));
  } else {
    retired_.add(work_->module, std::move(work_->other));
  }
}

void Exchanges::abort(const std::string& why) {
  if (work_->step == Step::Waiting) {
    work_->failure = why;
    leave();
    return;
  }
  answer(CommandResult::Failed, why);
  discard_other();
  work_.reset();
}

void Exchanges::set_version(VersionState state) {
  scheduler::ModuleRecord& module = record();
  const std::uint64_t number = module.version.load() + 1;
  rt::copy_text(module.digests[number % 2], running().digest());
  module.version_tick.store(work_->report.tick);
  module.version_state.store(state);
  module.version.store(number, std::memory_order_release);
}

// The schedule has ended: no run is in progress, and none will be exchanged.
void Exchanges::end_work() {
  if (work_->preparation != nullptr) {
    (void)work_->preparation->take();
  }
  while (work_->call != nullptr && !phases_.ended(*work_->call, rt::MonoClock::now(), Phases::kGrace)) {
    rt::sleep_until(rt::MonoClock::now() + kEndPoll);
  }
  if (work_->call != nullptr) {
    work_->other_is_unsound = Phases::failure_of(std::move(work_->call)).has_value();
  }
  const bool runs = work_->exchange != nullptr && work_->exchange->step() != Exchange::Step::Waiting &&
                    work_->exchange->step() != Exchange::Step::Back;
  if (runs != work_->exchanged) {
    std::swap(running(), work_->other);  // stop() of the version that ran last is called with the others
    work_->exchanged = runs;
  }
  answer(CommandResult::Ending, "the node ends");
  if (work_->preparation == nullptr) {
    discard_other();
  }
  work_.reset();
}

void Exchanges::end() {
  if (work_) {
    end_work();
  }
  for (auto& [module, library] : previous_) {
    retired_.add(module, std::move(library));
  }
  previous_.clear();
  retired_.end();
}

}  // namespace indurop::node
