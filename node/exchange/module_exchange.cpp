// SPDX-License-Identifier: Apache-2.0
// What is commanded. The way from a version that is ready to the end of its health window is in
// module_exchange_run.cpp.
#include "node/exchange/module_exchange.h"

#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/version_text.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleState;

}  // namespace

bool ModuleExchange::is_open() const noexcept {
  return step_ >= Step::Waiting && step_ != Step::Over &&
         (step_ != Step::Watched || exchange_->step() != scheduler::Exchange::Step::Done);
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
      return go_on_preparing(now);
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

void ModuleExchange::go_on_preparing(rt::MonoTime now) {
  switch (prepare(now)) {
    case Progress::Working:
      return;
    case Progress::Answered:
      step_ = Step::Over;
      return;
    case Progress::GivenUp:
      return abort(failure_);
    case Progress::Ready:
      return prepared();
  }
}

void ModuleExchange::prepared() {
  if (would_run()) {
    if (held_) {
      step_ = Step::Ready;
    } else {
      watch(next_macro_period(context_));
    }
  } else if (is_started_ || held_) {
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
