// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/node_choice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>

#include "core/rt/clock.h"
#include "store/vars/node_lock.h"
#include "store/vars/nodes.h"
#include "store/vars/shm_file.h"
#include "tools/client/node/starting_node.h"
#include "tools/client/text/suggest.h"
#include "tools/client/text/units.h"
#include "tools/client/values/here_source.h"
#include "tools/client/values/peer_address.h"
#include "tools/client/values/remote_source.h"

namespace indurop::tools {
namespace {

Result<std::string, Failure> named_node(const std::string& name, const char* origin) {
  if (!vars::valid_node_name(name)) {
    return Failure{
        kUsage, fmt::format("'{}' ({}) is not a valid node name: 1 to 40 of A-Z a-z 0-9 _ -", printable(name), origin)};
  }
  while_starting([&] { return vars::running_node(name) != 0; });
  if (vars::has_node(name, vars::Nodes::All)) {
    return name;
  }
  const auto names = vars::list_nodes();
  const auto running = vars::running_nodes();
  return Failure{
      kUnreachable,
      running.empty()
          ? fmt::format("there is no node '{}'.{} None runs on this machine. Start one: indurop run module.xml", name,
                        did_you_mean(name, names))
          : fmt::format("there is no node '{}'.{} Nodes that run here: {}", name, did_you_mean(name, running),
                        fmt::join(running, ", "))};
}

Result<vars::Store, Failure> open_remote(Access& access, const std::vector<std::string>& names) {
  if (!access.node.empty()) {
    return Failure{kUsage, "--node names a node of this machine; boards in the network are chosen by NAME@BOARD"};
  }
  dds::NetworkSettings network = access.remote.network;
  auto peers = peer_addresses(network.peers, rt::MonoClock::now() + std::chrono::nanoseconds(access.remote.wait_ns));
  if (!peers) {
    return std::move(peers).error();
  }
  network.peers = std::move(peers).value();
  std::vector<std::string> notes;
  auto source = RemoteSource::open(network, access.remote.wait_ns, names, notes);
  for (const std::string& note : notes) {
    access.messages->note(note);
  }
  if (!source.ok()) {
    return std::move(source).error();
  }
  access.values = std::move(source).value();
  auto store = access.values->attach();
  if (!store.ok()) {
    return Failure{kFailed, fmt::format("no memory for the values: {}", store.error().where)};
  }
  return std::move(store).value();
}

}  // namespace

Result<std::string, Failure> choose_node(const std::string& asked) {
  if (!asked.empty()) {
    return named_node(asked, "--node");
  }
  if (const std::string environment = vars::node_of_environment(); !environment.empty()) {
    return named_node(environment, "$INDUROP_NODE");
  }
  std::vector<std::string> names;
  while_starting([&] {
    names = vars::running_nodes();
    return !names.empty();
  });
  names = names.empty() ? vars::list_nodes() : names;
  if (std::string usual = vars::usual_node(names); !usual.empty()) {
    return usual;
  }
  if (names.empty()) {
    return Failure{kUnreachable,
                   "no node on this machine. Start one: indurop run module.xml; boards in the network: --remote"};
  }
  return Failure{kUsage, fmt::format("there are several nodes; say which with --node: {}", fmt::join(names, ", "))};
}

namespace {

// Returns the formats that differ: " (format of its store 4, here 5)".
std::string formats_of(const std::string& node) {
  std::vector<std::string> differing;
  const auto compare = [&](const char* what, std::uint32_t found, std::uint32_t known) {
    if (found != 0 && found != known) {
      differing.push_back(fmt::format("format of its {} {}, here {}", what, found, known));
    }
  };
  compare("store", vars::store_format(node), abi::kVersion);
  constexpr std::size_t kHead = offsetof(scheduler::RunBlock, module_count);
  const auto run = vars::RunFile::open(node, vars::Mode::ReadOnly, scheduler::kRunMagic, kHead);
  compare("run block", run ? static_cast<const scheduler::RunBlock*>(run->data())->abi : 0, scheduler::kRunAbi);
  return differing.empty() ? std::string() : fmt::format(" ({})", fmt::join(differing, "; "));
}

}  // namespace

std::string explain_open_error(const Error& error, const std::string& node, bool for_writing) {
  switch (error.code) {
    case Errc::NotFound:
      if (const pid_t pid = vars::running_node(node); pid != 0) {
        return fmt::format(
            "node '{}' runs (pid {}), but its files in /dev/shm were removed or are not there yet. If it stays so: "
            "indurop stop --node {}, and start it again",
            node, pid, node);
      }
      return fmt::format("node '{}' is gone. Start it again: indurop run module.xml --node {}", node, node);
    case Errc::PermissionDenied:
      return fmt::format("no permission to {} node '{}': run as the user it belongs to (ls -l /dev/shm/indurop.{})",
                         for_writing ? "change values of" : "read", node, node);
    case Errc::VersionMismatch:
      return fmt::format(
          "node '{}' was started by another version of InduRoP{}: use that version's `indurop`, or "
          "restart the node",
          node, formats_of(node));
    case Errc::Dead:
      return fmt::format("the shared memory of node '{}' was truncated by another process: its values are lost", node);
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

Result<vars::Store, Failure> open_store(Access& access, vars::Mode mode, const std::vector<std::string>& names) {
  if (access.remote.wanted) {
    return open_remote(access, names);
  }
  auto node = choose_node(access.node);
  if (!node.ok()) {
    return std::move(node).error();
  }
  access.values = std::make_shared<HereSource>(*node, mode);
  auto store = access.values->attach();
  // A node that starts under a name that was used before shows the values of the former one until its own store exists.
  while_starting([&] {
    if (store.ok() && vars::is_running(*node, store->header())) {
      return true;
    }
    store = access.values->attach();
    return false;
  });
  if (!store.ok()) {
    return Failure{exit_code_of(store.error()),
                   explain_open_error(store.error(), *node, mode == vars::Mode::ReadWrite)};
  }
  access.node = *node;
  return std::move(store).value();
}

Result<ChosenRun, Failure> open_run(const std::string& asked) {
  auto node = choose_node(asked);
  if (!node.ok()) {
    return std::move(node).error();
  }
  auto run = RunView::open(*node);
  while_starting([&] {
    if (run.ok() && run->node_alive()) {
      return true;
    }
    run = RunView::open(*node);
    return false;
  });
  if (!run.ok()) {
    return Failure{exit_code_of(run.error()),
                   run.error().code == Errc::NotFound
                       ? fmt::format("node '{}' does not run and left no statistics behind", *node)
                       : explain_open_error(run.error(), *node, false)};
  }
  return ChosenRun{std::move(node).value(), std::move(run).value()};
}

std::string store_absence(const std::string& node, const vars::BlockHeader& header) {
  if (vars::is_running(node, header)) {
    return {};
  }
  const std::int64_t beat = header.heartbeat_ns.load(std::memory_order_relaxed);
  const std::int64_t age = rt::now_ns() - beat;
  return beat > 0 && age >= 0 ? fmt::format("not running, last seen {} ago", human_age(age)) : "not running";
}

}  // namespace indurop::tools
