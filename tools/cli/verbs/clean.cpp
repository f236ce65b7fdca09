// SPDX-License-Identifier: Apache-2.0
// indurop clean: removes files that nodes which do not run any more left in shared memory.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "store/vars/node_lock.h"
#include "store/vars/shm_file.h"
#include "tools/cli/verbs/verbs.h"
#include "tools/client/node/node_choice.h"

namespace indurop::tools {
namespace {

// Returns nodes with any file, also those without a store (killed while they started).
std::vector<std::string> nodes_with_files() {
  std::vector<std::string> names = vars::list_nodes();
  std::error_code error;
  constexpr std::string_view kPrefix = "indurop.";
  for (const auto& entry : std::filesystem::directory_iterator(vars::kShmDirectory, error)) {
    std::string name = entry.path().filename().string();
    if (!name.starts_with(kPrefix)) {
      continue;
    }
    name = name.substr(kPrefix.size());
    name = name.substr(0, name.find('.'));
    if (vars::valid_node_name(name)) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Returns the nodes to clean; empty if there is nothing.
Result<std::vector<std::string>, Failure> chosen(const Context& context, bool all) {
  std::string name = context.node;
  const char* environment = std::getenv("INDUROP_NODE");
  if (name.empty() && !all && environment != nullptr) {
    name = environment;
  }
  if (!name.empty()) {
    if (!vars::valid_node_name(name)) {
      return Failure{kUsage, fmt::format("'{}' is not a valid node name: 1 to 40 of A-Z a-z 0-9 _ -", name)};
    }
    const auto there = nodes_with_files();
    return std::find(there.begin(), there.end(), name) != there.end() ? std::vector{name} : std::vector<std::string>{};
  }
  auto names = nodes_with_files();
  if (all || names.size() <= 1) {
    return names;
  }
  if (const std::string usual = vars::default_node(); std::find(names.begin(), names.end(), usual) != names.end()) {
    return std::vector<std::string>{usual};
  }
  return Failure{kUsage,
                 fmt::format("there are several nodes; say which with --node, or --all: {}", fmt::join(names, ", "))};
}

int clean(Context& context, bool all) {
  const auto names = chosen(context, all);
  if (!names) {
    return report(context.out, names.error());
  }
  int code = kOk;
  std::size_t removed = 0;
  for (const std::string& name : *names) {
    const Status status = vars::remove_node(name);
    if (status.ok()) {
      context.out.line(fmt::format("removed the shared memory of node '{}'", name));
      ++removed;
    } else if (status.error().code == Errc::Busy && all) {
      context.out.note(fmt::format("node '{}' runs: left alone", name));
    } else if (const std::string owner = vars::other_owner(name); all && !owner.empty()) {
      context.out.note(fmt::format("node '{}' is user {}'s: left alone", name, owner));
    } else if (status.error().code == Errc::Busy) {
      context.out.error(fmt::format("node '{}' runs; stop it first: indurop stop --node {}", name, name));
      code = kFailed;
    } else {
      context.out.error(fmt::format("node '{}': {}{}{}", name, status.error().where,
                                    status.error().sys_errno != 0 ? ": " : "",
                                    status.error().sys_errno != 0 ? std::strerror(status.error().sys_errno) : ""));
      code = kFailed;
    }
  }
  if (removed == 0 && code == kOk) {
    context.out.note("nothing to remove");
  }
  return code;
}

Action declare_clean(base::Options& app, Context& context) {
  auto all = std::make_shared<bool>(false);
  add_node_option(app, context);
  app.flag("--all", *all, "Every node that does not run");
  return [all](Context& c) { return clean(c, *all); };
}

}  // namespace

const Verb kCleanVerb{
    "clean", "Start and stop", "Remove the shared memory of nodes that do not run",
    "Deletes the values that such nodes left behind, except retained values, which are in files. A running node\n"
    "is never touched.\n"
    "Examples:\n"
    "  indurop clean --node local\n"
    "  indurop clean --all\n",
    &declare_clean};

}  // namespace indurop::tools
