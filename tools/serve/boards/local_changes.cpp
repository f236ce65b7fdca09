// SPDX-License-Identifier: Apache-2.0
// Changes of a local board: by store/operate/, the run block and the journal of alarms.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "control/plc/st/value_literal.h"
#include "store/operate/hold.h"
#include "store/operate/set.h"
#include "tools/client/node/module_command.h"
#include "tools/client/node/node_choice.h"
#include "tools/serve/boards/local_board.h"
#include "tools/serve/door/request.h"
#include "tools/serve/leases/lease_desk.h"

namespace indurop::serve {
namespace {

// Returns all values if they are valid, else what is wrong with each that is not.
Result<std::vector<operate::Assignment>, operate::Refusal> check_values(const vars::Store& store,
                                                                        const WriteRequest& request) {
  std::vector<operate::Assignment> all;
  operate::Refusal wrong;
  for (const auto& [name, value] : request.values) {
    auto item = operate::find(store, name);
    auto one = item ? operate::parse(store, std::move(item).value(), value, &plc::read_value_literal)
                    : Result<operate::Assignment, base::Problem>(std::move(item).error());
    if (one) {
      all.push_back(std::move(one).value());
    } else {
      wrong.reasons.push_back(one.error().text);
    }
  }
  if (!wrong.reasons.empty()) {
    return wrong;
  }
  return all;
}

std::vector<std::string> names_of(const std::vector<operate::Assignment>& all) {
  std::vector<std::string> names;
  std::transform(all.begin(), all.end(), std::back_inserter(names), [](const auto& one) { return one.item.name; });
  return names;
}

std::vector<std::string> names_of(const std::vector<operate::Item>& all) {
  std::vector<std::string> names;
  std::transform(all.begin(), all.end(), std::back_inserter(names), [](const auto& one) { return one.name; });
  return names;
}

const char* result_word(scheduler::CommandResult result) {
  return result == scheduler::CommandResult::Unchanged ? "unchanged"
         : result == scheduler::CommandResult::OldCode ? "old code"
                                                       : "done";
}

}  // namespace

Result<vars::Store, Refused> open_to_write(const std::string& node, bool running) {
  tools::HereSource source(node, vars::Mode::ReadWrite);
  auto store = source.attach();
  if (!store.ok()) {
    const bool denied = store.error().code == Errc::PermissionDenied;
    return Refused{denied ? status::kForbidden : status::kConflict,
                   {tools::explain_open_error(store.error(), node, true)}};
  }
  if (const std::string absence = source.absence(&store.value()); running && !absence.empty()) {
    return Refused{status::kConflict, {source.gone(absence) + ": forces are for a node that runs"}};
  }
  return std::move(store).value();
}

Refused refused_by(const std::string& node, const operate::Refusal& refusal) {
  using operate::Why;
  std::vector<std::string> reasons = refusal.reasons;
  if (refusal.why == Why::Locked) {
    reasons.front() = fmt::format("node '{}': {}", node, reasons.front());
  }
  int code = status::kWrongValue;
  if (refusal.why == Why::Locked) {
    code = status::kLocked;
  } else if (refusal.why == Why::Busy) {
    code = status::kNoAnswer;
  } else if (refusal.why == Why::Absent) {
    code = status::kConflict;
  }
  return {code, std::move(reasons)};
}

Refused LocalBoard::refused(const operate::Refusal& refusal) const {
  return refused_by(name(), refusal);
}

Board::Done LocalBoard::set(const WriteRequest& request, ChangeNote& note) {
  auto store = open_to_write(name(), false);
  if (!store) {
    return std::move(store).error();
  }
  const auto values = check_values(*store, request);
  if (!values) {
    return refused(values.error());
  }
  if (const auto held = operate::forced(*store, *values)) {
    return refused(*held);
  }
  if (const auto locked = operate::refusal_to_set(name(), *values)) {
    return refused(*locked);
  }
  if (auto unlogged = note.begin({names_of(*values)})) {
    return std::move(*unlogged);
  }
  if (const auto done = operate::set(name(), *store, *values, note.who()); !done) {
    return refused(done.error());
  }
  return base::Json{{"written", base::Json(names_of(*values))}};
}

Board::Done LocalBoard::force(const WriteRequest& request, ChangeNote& note, LeaseDesk& leases) {
  auto store = open_to_write(name(), true);
  if (!store) {
    return std::move(store).error();
  }
  const auto values = check_values(*store, request);
  if (!values) {
    return refused(values.error());
  }
  if (const auto locked = operate::refusal(name(), vars::Act::Force)) {
    return refused(*locked);
  }
  if (request.lease && store->header().virtual_ns.load() != 0) {
    return Refused{status::kConflict, {"the time of a simulation is not the one that a lease goes by: use for_ns"}};
  }
  if (auto unlogged = note.begin({names_of(*values)})) {
    return std::move(*unlogged);
  }
  auto held = operate::hold(name(), *store, *values, request.lease ? LeaseDesk::kLeaseNs : request.for_ns,
                            request.lease ? operate::Ends::UnlessRenewed : operate::Ends::AtTime, note.who());
  if (!held) {
    return refused(held.error());
  }
  base::Json body{{"forced", base::Json(names_of(*values))}};
  if (request.lease) {
    body["lease"] =
        leases.take(name(), {note.who(), text_of(request), names_of(*values)}, *store, std::move(held).value());
    body["lease_ns"] = LeaseDesk::kLeaseNs;
  }
  return body;
}

Board::Done LocalBoard::release(const WriteRequest& request, ChangeNote& note) {
  auto store = open_to_write(name(), false);
  if (!store) {
    return std::move(store).error();
  }
  const auto items = operate::select(*store, request.names);
  if (!items) {
    return Refused{status::kWrongValue, items.error()};
  }
  if (const auto locked = operate::refusal(name(), vars::Act::Force)) {
    return refused(*locked);
  }
  if (auto unlogged = note.begin({names_of(*items), request.all})) {
    return std::move(*unlogged);
  }
  const auto released = request.all ? operate::release_all(name(), *store, note.who())
                                    : operate::release(name(), *store, *items, note.who());
  if (!released) {
    return refused(released.error());
  }
  return base::Json{{"released", base::Json(*released)}};
}

Board::Done LocalBoard::set_lock(vars::WriteLock lock, ChangeNote& note) {
  if (auto unlogged = note.begin({{}, true})) {
    return std::move(*unlogged);
  }
  if (const auto locked = operate::set_lock(name(), lock, note.who()); !locked) {
    return refused(locked.error());
  }
  return base::Json{{"lock", vars::word_of(lock)}};
}

Board::Done LocalBoard::command(scheduler::ModuleCommand what, const std::string& module, ChangeNote& note) {
  constexpr std::int64_t kLongestCommandNs = 10'000'000'000;
  const auto run = this->run();
  bool known = false;
  for (std::uint32_t i = 0; run && i < run->module_count(); ++i) {
    known = known || tools::fixed_text(run->module(i).name) == module;
  }
  if (!known) {
    return Refused{status::kNotFound, {fmt::format("board {} has no module '{}'", name(), module)}};
  }
  if (const auto locked = operate::refusal(name(), vars::Act::Command)) {
    return refused(*locked);
  }
  if (auto unlogged = note.begin({{}, true, what == scheduler::ModuleCommand::Stop})) {
    return std::move(*unlogged);
  }
  const auto done = tools::command_module(name(), what, module, kLongestCommandNs, note.who());
  if (!done) {
    return Refused{done.error().code == kUnreachable && alive() ? status::kNoAnswer : status::kConflict,
                   {done.error().text}};
  }
  return base::Json{
      {"module", module}, {"result", result_word(done->result)}, {"took_ns", done->took_ns}, {"message", done->text}};
}

Board::Done LocalBoard::carry_out(const alarms::AlarmOrder& order, ChangeNote& note) {
  if (auto unlogged = note.begin({order.names, order.all})) {
    return std::move(*unlogged);
  }
  alarms::AlarmJournal journal(name());
  const auto done = alarms::carry_out(journal, declared_alarms(), order);
  if (!done) {
    return Refused{done.error().failed ? status::kFailed : status::kWrongValue, done.error().texts};
  }
  return base::Json{{"alarms", base::Json(*done)}};
}

}  // namespace indurop::serve
