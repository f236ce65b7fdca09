// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/version_exchange.h"

#include <fmt/format.h>

#include <utility>

#include "core/rt/clock.h"
#include "node/exchange/schedule_change.h"
#include "node/exchange/version_text.h"
#include "scheduler/module_version.h"
#include "store/operate/journal.h"

namespace indurop::node {

using scheduler::CommandResult;
using scheduler::Exchange;

void ExchangeContext::offer_to_track(std::uint32_t module, const ModuleLibrary& version) const {
  if (track_of(module) != nullptr) {
    offer_to_track(module, version.uses());
    track_of(module)->set_other_version(version.number());
  }
}

void ExchangeContext::offer_to_track(std::uint32_t module, const ModuleLibrary::Uses& uses) const {
  std::vector<tape::VariableUse> on_tape;
  for (const auto& [name, use] : uses) {
    // The place that now has the name of a variable whose type changes is not the one that this version uses.
    const vars::DirectoryEntry* const entry = parts.store.find(name);
    if (entry != nullptr && entry->type_hash == use.type) {
      on_tape.push_back({static_cast<std::uint32_t>(entry - parts.store.directory().data()), use.reads, use.writes});
    }
  }
  for (const std::uint32_t variable : parts.tape->offer(module, on_tape)) {
    parts.console.warning("{} is too large for the tape of module {} and is not recorded until the node starts again",
                          parts.store.schema().variables[parts.store.directory()[variable].schema_index].name,
                          parts.config.modules[module].name);
  }
}

void ExchangeContext::set_on_track(std::uint32_t module, const ModuleLibrary& version) const {
  if (tape::Track* const track = track_of(module); track != nullptr) {
    offer_to_track(module, version);
    track->take_offered();
    track->set_version(version.number());
  }
}

std::uint64_t next_macro_period(const ExchangeContext& context) {
  return next_in(context.schedule->grid(), context.parts.run.tick.load());
}

bool VersionExchange::accept(const operate::ReloadRequest& request, const std::string& running) {
  request_ = request;
  report_.module = record().name;
  report_.from = running;
  if (request_.guard.empty()) {
    return true;
  }
  auto guard = GuardCondition::parse(request_.guard, context_.parts.store);
  if (!guard) {
    answer(CommandResult::Refused, guard.error().text);
    return false;
  }
  guard_ = std::move(guard).value();
  return true;
}

void VersionExchange::note_not_kept(const Candidate& candidate) const {
  for (const std::string& note : candidate.notes) {
    context_.parts.console.warning(
        "module {}: a replay of recordings across this exchange needs a file that is not "
        "kept: {}",
        record().name, note);
  }
}

void VersionExchange::answer(CommandResult result, const std::string& text) {
  if (result_) {
    return;
  }
  result_ = result;
  report_.text = text;
  report_.version = record().version.load();
  if (!held_) {
    (void)operate::write_report(context_.parts.node, report_);
    scheduler::answer_command(record(), result);
  }
  if (result == CommandResult::Refused || result == CommandResult::Failed) {
    context_.parts.console.warning("module {}: not exchanged: {}", record().name, text);
  }
}

void VersionExchange::set_version(scheduler::VersionState state, const std::string& digest) {
  scheduler::set_version(record(), digest, report_.tick, state);
}

void VersionExchange::report_return(Exchange::Reason reason, const std::string& digest, const std::string& who) {
  const std::string why = text_of(reason, record());
  report_.text = "the previous version runs again: " + why;
  report_.version = record().version.load() + 1;
  if (!held_) {
    (void)operate::write_report(context_.parts.node, report_);
  }
  if (reason != Exchange::Reason::Command) {  // that one is noted by its client
    operate::note(context_.parts.node, {rt::to_ns(context_.parts.store.now()), 0, "the node", "", "reload --back",
                                        record().name, "sha256:" + digest, 0, why});
  }
  set_version(scheduler::VersionState::Returned, digest);
  context_.parts.console.warning("module {}: version {} ({}), {} since tick {}: {}", record().name,
                                 record().version.load(), short_digest(digest), who, report_.tick, why);
  answer(CommandResult::Done, report_.text);
}

}  // namespace indurop::node
