// SPDX-License-Identifier: Apache-2.0
#include "tools/node_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "rt/clock.h"
#include "tools/far_values.h"
#include "tools/suggest.h"
#include "tools/units.h"
#include "vars/process.h"
#include "vars/shm_file.h"

namespace indurop::tools {
namespace {

constexpr const char* kDefaultNode = "local";

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::optional<std::string> named_node(Context& context, const std::string& name, const char* origin, int& code) {
  if (!vars::valid_node_name(name)) {
    context.out.error(fmt::format("'{}' ({}) is no node name: 1 to 40 of A-Z a-z 0-9 _ -", printable(name), origin));
    code = kUsage;
    return {};
  }
  const auto names = vars::list_nodes();
  if (!contains(names, name)) {
    context.out.error(
        names.empty()
            ? fmt::format("there is no node '{}', nor any other on this machine. Start one: indurop run module.xml",
                          name)
            : fmt::format("there is no node '{}'.{} Nodes here: {}", name, did_you_mean(name, names),
                          fmt::join(names, ", ")));
    code = kUnreachable;
    return {};
  }
  return name;
}

}  // namespace

std::optional<std::string> choose_node(Context& context, int& code) {
  if (!context.node.empty()) {
    return named_node(context, context.node, "--node", code);
  }
  const char* environment = std::getenv("INDUROP_NODE");
  if (environment != nullptr && *environment != '\0') {
    return named_node(context, environment, "$INDUROP_NODE", code);
  }
  const auto names = vars::list_nodes();
  if (contains(names, kDefaultNode)) {
    return kDefaultNode;
  }
  if (names.size() == 1) {
    return names.front();
  }
  if (names.empty()) {
    context.out.error("no node on this machine. Start one: indurop run module.xml; boards in the network: --remote");
    code = kUnreachable;
  } else {
    context.out.error(fmt::format("there are several nodes; say which with --node: {}", fmt::join(names, ", ")));
    code = kUsage;
  }
  return {};
}

std::string explain_open_error(const Error& error, const std::string& node, bool for_writing) {
  switch (error.code) {
    case Errc::NotFound:
      return fmt::format("node '{}' is gone. Start it again: indurop run module.xml --node {}", node, node);
    case Errc::PermissionDenied:
      return fmt::format("no permission to {} node '{}': run as the user it belongs to (ls -l /dev/shm/indurop.{})",
                         for_writing ? "change values of" : "look at", node, node);
    case Errc::VersionMismatch:
      return fmt::format(
          "node '{}' was started by another version of InduRoP: use that version's `indurop`, or restart the node",
          node);
    case Errc::Corrupt:
      return fmt::format("the shared memory of node '{}' is damaged ({}). If it does not run: indurop clean --node {}",
                         node, error.where, node);
    case Errc::Busy:
    case Errc::Timeout:
      return fmt::format("node '{}' is just starting; try again", node);
    default:
      return fmt::format("node '{}': {}{}{}", node, error.where, error.sys_errno != 0 ? ": " : "",
                         error.sys_errno != 0 ? std::strerror(error.sys_errno) : "");
  }
}

int exit_code_of(const Error& error) {
  switch (error.code) {
    case Errc::NotFound:
    case Errc::Busy:
    case Errc::Timeout:
    case Errc::Dead:
      return kUnreachable;
    case Errc::VersionMismatch:
    case Errc::TypeMismatch:
      return kSchemaMismatch;
    default:
      return kFailed;
  }
}

std::optional<vars::Store> open_store(Context& context, vars::Mode mode, int& code) {
  if (context.far.wanted) {
    if (!context.node.empty()) {
      context.out.error("--node names a node of this machine; boards in the network are chosen by NAME@BOARD");
      code = kUsage;
      return {};
    }
    context.far_values = FarValues::open(context, code);
    auto store = context.far_values == nullptr ? Result<vars::Store>(Error{}) : context.far_values->attach();
    if (context.far_values != nullptr && !store.ok()) {
      context.out.error(fmt::format("no memory for the values: {}", store.error().where));
      code = kFailed;
    }
    return store.ok() ? std::optional(std::move(store).value()) : std::nullopt;
  }
  const auto node = choose_node(context, code);
  if (!node) {
    return {};
  }
  auto store = vars::Store::attach(*node, mode);
  if (!store.ok()) {
    context.out.error(explain_open_error(store.error(), *node, mode == vars::Mode::ReadWrite));
    code = exit_code_of(store.error());
    return {};
  }
  context.node = *node;
  return std::move(store).value();
}

std::optional<RunView> open_run(Context& context, std::string& node, int& code) {
  const auto chosen = choose_node(context, code);
  if (!chosen) {
    return {};
  }
  node = *chosen;
  auto run = RunView::open(node);
  if (!run.ok()) {
    context.out.error(run.error().code == Errc::NotFound
                          ? fmt::format("node '{}' does not run and left no statistics behind", node)
                          : explain_open_error(run.error(), node, false));
    code = exit_code_of(run.error());
    return {};
  }
  return std::move(run).value();
}

bool store_alive(const vars::BlockHeader& header) {
  return vars::process_alive(header.node_pid.load(std::memory_order_relaxed),
                             header.node_start_time.load(std::memory_order_relaxed));
}

std::string values_absence(const Context& context, const vars::Store& store) {
  return context.far_values != nullptr ? context.far_values->absence() : store_absence(store.header());
}

std::string values_of(const Context& context) {
  return context.far_values != nullptr ? context.far_values->title() : fmt::format("node '{}'", context.node);
}

std::string name_of_source(const Context& context) {
  return context.far_values != nullptr ? context.far_values->title() : context.node;
}

std::string store_absence(const vars::BlockHeader& header) {
  if (store_alive(header)) {
    return {};
  }
  const std::int64_t beat = header.heartbeat_ns.load(std::memory_order_relaxed);
  const std::int64_t age = rt::now_ns() - beat;
  return beat > 0 && age >= 0 ? fmt::format("not running, last seen {} ago", human_age(age)) : "not running";
}

}  // namespace indurop::tools
