// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/program_exchange.h"

#include <utility>

#include "node/exchange/version_text.h"
#include "node/modules/kept_versions.h"

namespace indurop::node {

using scheduler::CommandResult;

void ProgramExchange::begin(const operate::ReloadRequest& request) {
  if (!accept(request, processes_.program(module_).digest)) {
    return;
  }
  checked_.file = request_.file.empty() ? context_.files[module_] : std::filesystem::path(request_.file);
  CandidateTask task{context_.parts.config,
                     module_,
                     checked_.file,
                     context_.parts.store,
                     context_.allowed[module_],
                     context_.parts.libraries[module_]};
  task.may_grow = held_ || context_.parts.may_grow;
  task.ends_first = ends_first_;
  if (!request_.dry_run && processes_.pid(module_) > 0) {
    task.keep_for = context_.parts.node;
    task.process = processes_.pid(module_);
  }
  preparation_ = std::make_unique<CandidateThread>(std::move(task));
}

ProgramExchange::Progress ProgramExchange::check() {
  if (preparation_ != nullptr && !preparation_->is_done()) {
    return Progress::Working;
  }
  if (preparation_ == nullptr) {
    return Progress::Answered;
  }
  Candidate candidate = preparation_->take();
  preparation_.reset();
  if (is_given_up_) {
    answer(CommandResult::Failed, kGivenUp);
    return Progress::Answered;
  }
  if (!is_changed(candidate) || !is_wanted(candidate)) {
    return Progress::Answered;
  }
  note_not_kept(candidate);
  variables_ = std::move(candidate.variables);
  if (!variables_.let_appear(context_.parts.store)) {
    answer(CommandResult::Failed, "another version has brought other variables meanwhile; repeat the command");
    return Progress::Answered;
  }
  uses_ = candidate.library.uses();
  checked_.mark = candidate.mark;
  checked_.digest = candidate.digest;
  if (context_.track_of(module_) != nullptr) {
    const std::string file = std::filesystem::absolute(checked_.file).string();
    checked_.version = context_.parts.tape->versions().add(module_, checked_.digest, file);
    context_.offer_to_track(module_, uses_);
  }
  return Progress::Ready;
}

void ProgramExchange::end_check() {
  if (preparation_ != nullptr) {
    (void)preparation_->take();
    preparation_.reset();
  }
}

bool ProgramExchange::is_changed(const Candidate& candidate) {
  report_.errors = candidate.errors;
  report_.needs_restart = candidate.needs_restart;
  report_.to = candidate.digest;
  if (!report_.errors.empty()) {
    answer(CommandResult::Refused, count_errors(report_));
  } else if (report_.from == report_.to) {
    answer(CommandResult::Unchanged, "this version runs already");
  }
  return !result();
}

void ProgramExchange::swap_uses() {
  ModuleLibrary& module = context_.parts.libraries[module_];
  ModuleLibrary::Uses former = module.uses();
  module.set_uses(std::exchange(uses_, std::move(former)));
}

void ProgramExchange::find_kept(Processes::Program& program) const {
  const auto same = find_version_file(context_.parts.node, program.digest, {program.file}, program.file.parent_path());
  if (same && *same != program.file) {
    program.file = *same;
    program.mark = mark_of(*same);
  }
}

}  // namespace indurop::node
