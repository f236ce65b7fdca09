// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/thread_exchange.h"

#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/version_text.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

using scheduler::CommandResult;

constexpr std::chrono::seconds kStartOfVersion{10};  // for start() of a new version
constexpr std::chrono::milliseconds kVersionPoll{1};

}  // namespace

void ThreadExchange::begin(const operate::ReloadRequest& request) {
  if (!accept(request, running().digest())) {
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

ThreadExchange::Progress ThreadExchange::prepare(rt::MonoTime now) {
  if (preparation_ != nullptr) {
    if (!preparation_->is_done()) {
      return Progress::Working;
    }
    if (!take_candidate()) {
      return Progress::Answered;
    }
    if (failure_.empty()) {
      start_other();
    }
  }
  if (call_ != nullptr) {
    if (!context_.phases.ended(*call_, now, kStartOfVersion)) {
      return Progress::Working;
    }
    if (auto failed = Phases::failure_of(std::move(call_))) {
      other_is_unsound_ = true;
      failure_ = *std::move(failed);
    } else {
      runtime::bind_back(other_.inside());
    }
  }
  if (result()) {
    return Progress::Answered;
  }
  if (failure_.empty() && !variables_.let_appear(context_.parts.store)) {
    failure_ = "another version has brought other variables meanwhile; repeat the command";
  }
  return failure_.empty() ? Progress::Ready : Progress::GivenUp;
}

bool ThreadExchange::take_candidate() {
  Candidate candidate = preparation_->take();
  preparation_.reset();
  if (!is_wanted(candidate)) {
    return false;
  }
  note_not_kept(candidate);
  other_ = std::move(candidate.library);
  carry_ = std::move(candidate.carry);
  variables_ = std::move(candidate.variables);
  if (context_.track_of(module_) != nullptr) {
    const std::string file = std::filesystem::absolute(other_.file()).string();
    other_.set_number(context_.parts.tape->versions().add(module_, other_.digest(), file));
  }
  return true;
}

// Returns false if it was answered that nothing is exchanged.
bool ThreadExchange::is_wanted(const Candidate& candidate) {
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

void ThreadExchange::start_other() {
  auto* start = other_.functions().start;
  if (start == nullptr || !would_run()) {
    return;
  }
  runtime::bind_apart(other_.inside());
  call_ = context_.phases.begin(module_, "start", start);
  is_started_ = call_ != nullptr;
  failure_ = call_ == nullptr ? "start() could not be called" : "";
}

bool ThreadExchange::end_preparation() {
  const bool prepared = preparation_ == nullptr;
  if (!prepared) {
    (void)preparation_->take();
  }
  while (call_ != nullptr && !context_.phases.ended(*call_, rt::MonoClock::now(), Phases::kGrace)) {
    rt::sleep_until(rt::MonoClock::now() + kVersionPoll);
  }
  if (call_ != nullptr) {
    other_is_unsound_ = Phases::failure_of(std::move(call_)).has_value();
  }
  return prepared;
}

}  // namespace indurop::node
