// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/module_reload.h"

#include <fmt/format.h>

#include <utility>

#include "core/rt/clock.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleCommand;
using scheduler::VersionState;

constexpr std::int64_t kLockPollNs = 10'000'000;
constexpr std::size_t kShownDigits = 12;

}  // namespace

// One exchange at a time: the request is a file of the node.
Result<operate::ReloadLock, Failure> lock_when_free(const std::string& node, std::int64_t timeout_ns) {
  const std::int64_t end = rt::now_ns() + timeout_ns;
  for (;;) {
    auto lock = operate::ReloadLock::acquire(node);
    if (lock) {
      return std::move(lock).value();
    }
    if (lock.error().code != Errc::Busy) {
      return Failure{kFailed, fmt::format("the folder of node '{}' cannot be written by this user", node)};
    }
    if (rt::now_ns() >= end || wait_until(rt::now_ns() + kLockPollNs) == Woken::Signal) {
      return Failure{interrupted() ? interrupt_code() : kUnreachable,
                     fmt::format("another process is exchanging a module of node '{}'", node)};
    }
  }
}

Result<Reloaded, Failure> reload_module(const std::string& node, ModuleCommand command, const std::string& module,
                                        const operate::ReloadRequest& request, std::int64_t timeout_ns,
                                        const operate::Who& who) {
  const auto lock = lock_when_free(node, timeout_ns);
  if (!lock) {
    return lock.error();
  }
  if (command == ModuleCommand::Reload && !operate::write_request(node, request)) {
    return Failure{kFailed, fmt::format("the folder of node '{}' cannot be written by this user", node)};
  }
  auto answer = await_answer(node, command, module, timeout_ns);
  if (!answer) {
    return answer.error();
  }
  if (answer->result == CommandResult::Ending) {
    return Failure{kUnreachable, fmt::format("module '{}' was not exchanged: the node itself ends", module)};
  }
  auto report = operate::read_report(node);
  if (!report || report->module != module) {
    return Failure{kFailed, fmt::format("node '{}' left no report of the exchange", node)};
  }
  if (answer->result == CommandResult::Done && !request.dry_run) {
    note_command(node, answer->run, command, module, "sha256:" + report->to, who);
  }
  return Reloaded{node, std::move(answer).value(), *std::move(report)};
}

std::string version_text(const scheduler::ModuleRecord& module) {
  const std::uint64_t version = module.version.load(std::memory_order_acquire);
  if (version < 2) {
    return {};
  }
  const VersionState state = module.version_state.load();
  return fmt::format("version {} ({}) since tick {}{}", version,
                     fixed_text(module.digests[version % 2]).substr(0, kShownDigits), module.version_tick.load(),
                     state == VersionState::Watched    ? ", watched"
                     : state == VersionState::Returned ? ", the previous one again"
                                                       : "");
}

}  // namespace indurop::tools
