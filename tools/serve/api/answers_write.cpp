// SPDX-License-Identifier: Apache-2.0
// Answers that change something: values, forces, modules. The store is open for writing only during the write.
#include <fmt/format.h>

#include <utility>

#include "control/plc/st/value_literal.h"
#include "store/operate/hold.h"
#include "store/operate/set.h"
#include "tools/cli/plant/commands.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/wish.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/board.h"
#include "tools/serve/boards/variable.h"
#include "tools/serve/leases/lease_desk.h"

namespace indurop::serve::answers {
namespace {

// Returns all values if they are valid, else what is wrong with each that is not.
Result<std::vector<operate::Assignment>, operate::Refusal> check_values(const vars::Store& store, const Wish& wish) {
  std::vector<operate::Assignment> all;
  operate::Refusal wrong;
  for (const auto& [name, value] : wish.values) {
    if (name.empty() || name.find('=') != std::string::npos) {
      wrong.reasons.push_back(fmt::format("'{}' is no name of a variable", name));
      continue;
    }
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

base::Json names_of(const std::vector<operate::Assignment>& all) {
  base::Json names = base::Json::array();
  for (const operate::Assignment& one : all) {
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
  const auto values = check_values(*store, *wish);
  if (!values) {
    return write.failed(values.error());
  }
  if (const auto forced = hold ? std::nullopt : operate::forced(*store, *values)) {
    return write.failed(*forced);
  }
  const std::string& node = (*found)->name();
  if (const auto locked = hold ? operate::refusal(node, vars::Act::Force) : operate::refusal_to_set(node, *values)) {
    return write.failed(*locked);
  }
  if (wish->lease && store->header().virtual_ns.load() != 0) {
    return write.failed(status::kConflict, "the time of a simulation is not the one that a lease goes by: use for_ns");
  }
  if (auto refused = write.begin()) {
    return *refused;
  }
  base::Json body = about(**found);
  if (!hold) {
    if (const auto done = operate::set(node, *store, *values, write.who()); !done) {
      return write.failed(done.error());
    }
  } else {
    auto held = operate::hold(node, *store, *values, wish->lease ? LeaseDesk::kLeaseNs : wish->for_ns,
                              wish->lease ? operate::Ends::UnlessRenewed : operate::Ends::ByItself, write.who());
    if (!held) {
      return write.failed(held.error());
    }
    if (wish->lease) {
      body["lease"] = api.leases().take(node, write.who(), text_of(*wish), *store, std::move(held).value());
      body["lease_ns"] = LeaseDesk::kLeaseNs;
    }
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
  if (const auto locked = operate::refusal((*found)->name(), vars::Act::Command)) {
    return write.failed(*locked);
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
  const auto items = operate::select(*store, wish->names);
  if (!items) {
    return write.failed(operate::Refusal{operate::Why::Wrong, items.error()});
  }
  const std::string& node = (*found)->name();
  if (const auto locked = operate::refusal(node, vars::Act::Force)) {
    return write.failed(*locked);
  }
  if (auto refused = write.begin()) {
    return *refused;
  }
  const auto released =
      wish->all ? operate::release_all(node, *store, write.who()) : operate::release(node, *store, *items, write.who());
  if (!released) {
    return write.failed(released.error());
  }
  base::Json body = about(**found);
  body["released"] = base::Json(*released);
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
