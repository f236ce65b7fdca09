// SPDX-License-Identifier: Apache-2.0
// Answers that change something: values, forces, modules. The store is opened to write for that moment only.
#include <fmt/format.h>

#include "serve/api/answers.h"
#include "serve/api/wish.h"
#include "serve/api/write.h"
#include "serve/boards/board.h"
#include "serve/boards/variable.h"
#include "serve/leases/lease_desk.h"
#include "tools/plant/commands.h"
#include "tools/values/forcing.h"
#include "tools/values/node_choice.h"

namespace indurop::serve::answers {
namespace {

// All values found good, or none.
std::optional<std::vector<tools::Assignment>> check_values(Write& write, const vars::Store& store, const Wish& wish,
                                                           const char* verb) {
  std::vector<tools::Assignment> all;
  bool fine = true;
  for (const auto& [name, value] : wish.values) {
    if (name.empty() || name.find('=') != std::string::npos) {
      write.context().out.error(fmt::format("'{}' is no name of a variable", name));
      fine = false;
      continue;
    }
    auto one = tools::read_assignments(write.context(), store, verb, {name, value});
    if (one) {
      all.push_back(std::move(one->front()));
    }
    fine = fine && one.ok();
  }
  return fine ? std::optional(std::move(all)) : std::nullopt;
}

base::Json names_of(const std::vector<tools::Assignment>& all) {
  base::Json names = base::Json::array();
  for (const tools::Assignment& one : all) {
    names.push_back(one.item.name);
  }
  return names;
}

Reply write_values(Api& api, const Call& call, bool hold) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, hold ? "force" : "set");
  const auto wish = read_wish(call.request->body);
  if (!wish || wish->values.empty()) {
    return write.failed(status::kBadRequest, wish ? "values is an object of NAME: value" : wish.error());
  }
  write.about(text_of(*wish), wish->reason);
  auto store = write.open(hold);
  if (!store) {
    return store.error();
  }
  const auto values = check_values(write, *store, *wish, hold ? "force" : "set");
  if (!values || (!hold && tools::any_forced(write.context(), *store, *values))) {
    return write.failed_with(kFailed);
  }
  if (!(hold ? tools::may(write.context(), (*found)->name(), vars::Act::Force)
             : tools::may_set(write.context(), *values))) {
    return write.locked();
  }
  if (wish->lease && store->header().virtual_ns.load() != 0) {
    return write.failed(status::kConflict, "the time of a simulation is not the one that a lease goes by: use for_ns");
  }
  if (auto refused = write.begin()) {
    return *refused;
  }
  tools::Lease lease;
  const int code = !hold         ? tools::set_values(write.context(), *store, *values)
                   : wish->lease ? tools::hold_values(write.context(), *store, *values, LeaseDesk::kLeaseNs, &lease)
                                 : tools::hold_values(write.context(), *store, *values, wish->for_ns);
  if (code != kOk) {
    return write.failed_with(code);
  }
  base::Json body = about(**found);
  if (wish->lease) {
    body["lease"] =
        api.leases().take((*found)->name(), call.who, call.request->from, text_of(*wish), *store, std::move(lease));
    body["lease_ns"] = LeaseDesk::kLeaseNs;
  }
  body[hold ? "forced" : "written"] = names_of(*values);
  return write.done(body);
}

Reply command(Api& api, const Call& call, scheduler::ModuleCommand what, std::string word) {
  constexpr std::int64_t kLongestCommandNs = 10'000'000'000;
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const std::string& module = call.part.find("module")->second;
  const auto run = (*found)->run();
  bool known = false;
  for (std::uint32_t i = 0; run && i < run->module_count(); ++i) {
    known = known || tools::fixed_text(run->module(i).name) == module;
  }
  if (!known) {
    return refusal(status::kNotFound, fmt::format("board {} has no module '{}'", (*found)->name(), module));
  }
  Write write(api, call, std::move(word));
  write.about(module, query_value(*call.request, "reason").value_or(""));
  if (!tools::may(write.context(), (*found)->name(), vars::Act::Command)) {
    return write.locked();
  }
  if (auto refused = write.begin()) {
    return *refused;
  }
  write.context().node = (*found)->name();
  const tools::Commanded done = tools::command_here(write.context(), what, module, kLongestCommandNs);
  if (done.code != kOk) {
    const bool ran = (*found)->alive();
    return write.failed(done.code == kUnreachable && ran ? status::kNoAnswer : status::kConflict, write.message());
  }
  base::Json body = about(**found);
  body["module"] = module;
  body["result"] = done.result == scheduler::CommandResult::Unchanged ? "unchanged"
                   : done.result == scheduler::CommandResult::OldCode ? "old code"
                                                                      : "done";
  body["took_ns"] = done.took_ns;
  body["message"] = write.message();
  return write.done(body);
}

}  // namespace

Reply set(Api& api, const Call& call) {
  return write_values(api, call, false);
}

Reply force(Api& api, const Call& call) {
  return write_values(api, call, true);
}

Reply release(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "release");
  const auto wish = read_wish(call.request->body);
  if (!wish || wish->names.empty() != wish->all) {
    return write.failed(status::kBadRequest, wish ? "name what to release: names, or all" : wish.error());
  }
  write.about(wish->all ? "all" : text_of(*wish), wish->reason);
  auto store = write.open(false);
  if (!store) {
    return store.error();
  }
  std::vector<tools::Item> items;
  const bool fine = wish->all || tools::select_items(write.context(), *store, wish->names, items) == kOk;
  if (!fine) {
    return write.failed_with(kFailed);
  }
  if (!tools::may(write.context(), (*found)->name(), vars::Act::Force)) {
    return write.locked();
  }
  if (auto refused = write.begin()) {
    return *refused;
  }
  std::vector<std::string> gone;
  const int code = wish->all ? tools::let_all_go(write.context(), *store, gone)
                             : tools::let_values_go(write.context(), *store, items, gone);
  if (code != kOk) {
    return write.failed_with(code);
  }
  base::Json body = about(**found);
  body["released"] = gone;
  return write.done(body);
}

Reply start_module(Api& api, const Call& call) {
  return command(api, call, scheduler::ModuleCommand::Start, "start");
}

Reply stop_module(Api& api, const Call& call) {
  return command(api, call, scheduler::ModuleCommand::Stop, "stop");
}

Reply restart_module(Api& api, const Call& call) {
  return command(api, call, scheduler::ModuleCommand::Restart, "restart");
}

}  // namespace indurop::serve::answers
