// SPDX-License-Identifier: Apache-2.0
// From the request to a version that is ready to run. The rest of the way is in module_exchange_run.cpp.
#include "node/exchange/module_exchange.h"

#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/version_text.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleState;

constexpr std::chrono::seconds kStartLimit{10};  // for start() of a new version
constexpr const char* kRunsNoMore = "the version that runs has faulted or was stopped meanwhile";

}  // namespace

bool ModuleExchange::is_open() const noexcept {
  return step_ >= Step::Waiting && step_ != Step::Over &&
         (step_ != Step::Watched || exchange_->step() != scheduler::Exchange::Step::Done);
}

void ModuleExchange::begin(const operate::ReloadRequest& request) {
  if (!accept(request, running().digest())) {
    step_ = Step::Over;
    return;
  }
  preparation_ = std::make_unique<CandidateThread>(CandidateTask{
      context_.parts.config, module_,
      request_.file.empty() ? context_.files[module_] : std::filesystem::path(request_.file), context_.parts.store,
      context_.allowed[module_], running(), module_, held_ || context_.parts.may_grow,
      held_ || context_.parts.keeps_types ? std::span<const ModuleLibrary>() : context_.parts.libraries,
      context_.configured,
      request_.dry_run || context_.track_of(module_) == nullptr ? std::string() : context_.parts.node});
}

void ModuleExchange::begin_back(scheduler::Exchange::Reason reason) {
  back_ = true;
  exchanged_ = false;
  other_is_unsound_ = false;
  failure_.clear();
  then_back_.reset();
  guard_.reset();
  saved_bytes_ = 0;
  request_ = {};
  report_ = {};
  reason_ = reason;
  other_ = std::move(context_.previous.extract(module_).mapped());
  carry_ = plan_carry(running().memory(), other_.memory(), most_in_tick(record().period_ns));
  report_.module = record().name;
  report_.plan = carry_.plan;
  report_.from = running().digest();
  report_.to = other_.digest();
  variables_ = VariableChange::back_to(context_.parts.store, other_.uses());
  (void)variables_.list(context_.parts.store, report_.plan);
  if (variables_.changes_types()) {
    carry_.carry_between_runs();
  }
  const auto against = objections(variables_, {context_.parts.store, context_.parts.config, context_.parts.libraries,
                                               context_.configured, module_});
  if (!against.empty()) {
    context_.parts.console.warning("module {}: the previous version cannot run: {}", record().name, against.front());
    answer(CommandResult::Refused, against.front());
    return abort(against.front());
  }
  watch(next_macro_period(context_));
}

void ModuleExchange::go_on(rt::MonoTime now) {
  switch (step_) {
    case Step::Preparing:
      return preparation_->is_done() ? prepared() : void();
    case Step::Starting:
      return context_.phases.ended(*call_, now, kStartLimit) ? started() : void();
    case Step::Waiting:
      return wait_for_exchange();
    case Step::Watched:
      return check_health();
    case Step::Leaving:
      return context_.parts.engine.has_passed(module_) ? has_left() : void();
    case Step::Ready:
    case Step::Over:
      return;
  }
}

void ModuleExchange::go_back() {
  if (back_) {
    return;
  }
  switch (step_) {
    case Step::Preparing:
    case Step::Starting:
      failure_ = kGivenUp;
      return;
    case Step::Ready:
      return abort(kGivenUp);
    case Step::Waiting:
      then_back_ = scheduler::Exchange::Reason::Command;  // if a run is faster
      return abort(kGivenUp);
    case Step::Watched:
      if (!exchange_->go_back(scheduler::Exchange::Reason::Command)) {
        then_back_ = scheduler::Exchange::Reason::Command;
        leave();
      }
      return;
    case Step::Leaving:
      then_back_ = scheduler::Exchange::Reason::Command;
      return;
    case Step::Over:
      return;
  }
}

void ModuleExchange::settle() {
  if (step_ == Step::Watched) {
    record().version_state.store(scheduler::VersionState::Settled);
    leave();
  }
}

void ModuleExchange::prepared() {
  Candidate candidate = preparation_->take();
  preparation_.reset();
  if (!is_wanted(candidate)) {
    step_ = Step::Over;
    return;
  }
  for (const std::string& note : candidate.notes) {
    context_.parts.console.warning(
        "module {}: a replay of recordings across this exchange needs a file that is not "
        "kept: {}",
        record().name, note);
  }
  other_ = std::move(candidate.library);
  carry_ = std::move(candidate.carry);
  variables_ = std::move(candidate.variables);
  if (context_.track_of(module_) != nullptr) {
    const std::string file = std::filesystem::absolute(other_.file()).string();
    other_.set_number(context_.parts.tape->versions().add(module_, other_.digest(), file));
  }
  if (failure_.empty()) {
    start_other();
  } else {
    abort(failure_);
  }
}

// Returns false if it was answered that nothing is exchanged.
bool ModuleExchange::is_wanted(Candidate& candidate) {
  report_.errors = candidate.errors;
  report_.needs_restart = candidate.needs_restart;
  report_.plan = candidate.carry.plan;
  report_.to = candidate.library.digest();
  if (!report_.errors.empty()) {
    answer(CommandResult::Refused, count_errors(report_));
  } else if (report_.from == report_.to) {
    answer(CommandResult::Unchanged, "this version runs already");
  } else if (guard_ && candidate.variables.changes_type_of(guard_->variable())) {
    answer(CommandResult::Refused, "the type of the variable of --guard changes; name another one");
  } else if (candidate.carry.loses && !request_.lossy) {
    answer(CommandResult::Refused, "values would be lost; --lossy exchanges it nevertheless");
  } else if (request_.dry_run) {
    answer(CommandResult::Done, report_.plan.with_state ? "would be exchanged, with what it keeps"
                                                        : "would be exchanged, with initial values");
  } else {
    return true;
  }
  return false;
}

void ModuleExchange::start_other() {
  auto* start = other_.functions().start;
  if (start == nullptr || record().state.load() != ModuleState::Running) {
    return started();
  }
  runtime::bind_apart(other_.inside());
  call_ = context_.phases.begin(module_, "start", start);
  step_ = Step::Starting;
  if (call_ == nullptr) {
    abort("start() could not be called");
  }
}

void ModuleExchange::started() {
  const bool was_called = call_ != nullptr;
  if (was_called) {
    if (const auto failure = Phases::failure_of(std::move(call_))) {
      other_is_unsound_ = true;
      return abort(*failure);
    }
    runtime::bind_back(other_.inside());
  }
  if (!failure_.empty()) {
    abort(failure_);
  } else if (!variables_.let_appear(context_.parts.store)) {
    abort("another version has brought other variables meanwhile; repeat the command");
  } else if (record().state.load() == ModuleState::Running) {
    if (held_) {
      step_ = Step::Ready;
    } else {
      watch(next_macro_period(context_));
    }
  } else if (was_called || held_) {
    abort(kRunsNoMore);
  } else {
    replace_closed();
  }
}

// It does not run, so that nothing has to be carried: `indurop start` calls start() of the new version.
void ModuleExchange::replace_closed() {
  const bool faulted = record().state.load() == ModuleState::Faulted;
  if (!context_.parts.engine.at_rest(module_)) {
    return abort("a run of it is still being ended; repeat the command");
  }
  if (const std::string why = variables_.change_at_once(context_.parts.store, request_.lossy); !why.empty()) {
    return abort(why);
  }
  context_.parts.engine.replace_closed(module_, {other_.functions().run, other_.functions().condition});
  std::swap(running(), other_);
  context_.set_on_track(module_, running());
  set_version(scheduler::VersionState::Settled, running().digest());
  answer(CommandResult::Done, "is stopped, and begins with this version at `indurop start`");
  if (faulted) {
    context_.retired.abandon(module_, std::move(other_));
  } else {
    other_.unload();  // its stop() was called
  }
  step_ = Step::Over;
}

}  // namespace indurop::node
