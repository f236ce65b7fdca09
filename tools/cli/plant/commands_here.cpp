// SPDX-License-Identifier: Apache-2.0
// Commands to modules of a node of this machine, through its run block.
#include <fmt/format.h>

#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "store/operate/journal.h"
#include "tools/cli/command/audit.h"
#include "tools/cli/command/interrupt.h"
#include "tools/cli/command/suggest.h"
#include "tools/cli/command/units.h"
#include "tools/cli/plant/commands.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/values/node_choice.h"

namespace indurop::tools {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleCommand;

constexpr std::int64_t kLookNs = 2'000'000;

// Returns the module's record; null after an error message.
scheduler::ModuleRecord* find_module(Context& context, RunView& run, const std::string& node,
                                     const std::string& module) {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    names.push_back(fixed_text(run.module(i).name));
    if (names.back() == module) {
      return &run.module_to_command(i);
    }
  }
  context.out.error(fmt::format("node '{}' has no module '{}'.{} indurop status lists them", node, printable(module),
                                did_you_mean(module, names)));
  return nullptr;
}

int conclude(Context& context, ModuleCommand command, const scheduler::ModuleRecord& record, CommandResult result,
             std::int64_t took_ns) {
  const std::string module = printable(fixed_text(record.name));
  switch (result) {
    case CommandResult::Done:
      context.out.note(fmt::format("module '{}' {} after {}", module, past_of(command), human_ns(took_ns)));
      return kOk;
    case CommandResult::OldCode:
      context.out.message_line(
          fmt::format("indurop: warning: module '{}' {}, with the code that was loaded when the node started: its file "
                      "is another one now. Stop and "
                      "run the node to load it",
                      module, past_of(command)));
      return kOk;
    case CommandResult::Unchanged:
      context.out.note(
          fmt::format("module '{}' {} already", module, command == ModuleCommand::Stop ? "is stopped" : "runs"));
      return kOk;
    case CommandResult::Ending:
      context.out.error(fmt::format("module '{}' was not {}: the node itself ends", module, past_of(command)));
      return kUnreachable;
    case CommandResult::Failed:
    case CommandResult::None:
      break;
  }
  const std::string why = printable(fixed_text(record.last_fault));
  context.out.error(
      fmt::format("module '{}' could not be {}{}", module, past_of(command), why.empty() ? "" : ": " + why));
  return kFailed;
}

void note(const Context& context, const std::string& node, const RunView& run, ModuleCommand command,
          const std::string& module) {
  const std::int64_t simulated = run.block().virtual_ns.load();
  const char* action = command == ModuleCommand::Stop ? "stop" : command == ModuleCommand::Start ? "start" : "restart";
  operate::note(
      node,
      {simulated != 0 ? simulated : rt::now_ns(), 0, context.who, context.from, action, module, {}, 0, context.reason});
  if (context.who.empty()) {  // requests by HTTP are in the server's audit log already
    (void)append_audit(usual_audit_file(),
                       {rt::wall_ns(), base::user_name(), "", node, action, module, "done", context.reason});
  }
}

}  // namespace

Commanded command_here(Context& context, ModuleCommand command, const std::string& module, std::int64_t timeout_ns) {
  const auto node = choose_node(context.node);
  if (!node) {
    return {report(context.out, node.error())};
  }
  auto run = RunView::open(*node, vars::Mode::ReadWrite);
  if (!run.ok()) {
    context.out.error(run.error().code == Errc::NotFound ? fmt::format("node '{}' does not run", *node)
                                                         : explain_open_error(run.error(), *node, true));
    return {exit_code_of(run.error())};
  }
  if (!run.value().node_alive() || run.value().block().state.load() != scheduler::NodeState::Running) {
    context.out.error(fmt::format("node '{}' does not run, so there is no module to be {}", *node, past_of(command)));
    return {kUnreachable};
  }
  if (!may(context, *node, vars::Act::Command)) {
    return {};
  }
  scheduler::ModuleRecord* record = find_module(context, run.value(), *node, module);
  if (record == nullptr) {
    return {};
  }
  const std::int64_t begin = rt::now_ns();
  std::optional<scheduler::CommandTicket> ticket;
  while (rt::now_ns() < begin + timeout_ns && !interrupted() && run.value().node_alive()) {
    if (!ticket) {
      ticket = scheduler::place_command(*record, command);
    } else if (const auto result = scheduler::result_of(*record, *ticket); result != CommandResult::None) {
      const std::int64_t took = rt::now_ns() - begin;
      if (result == CommandResult::Done || result == CommandResult::OldCode) {
        note(context, *node, run.value(), command, module);
      }
      return {conclude(context, command, *record, result, took), result, took};
    }
    wait_until(rt::now_ns() + kLookNs);
  }
  if (interrupted()) {
    return {interrupt_code()};
  }
  context.out.error(run.value().node_alive()
                        ? fmt::format("module '{}' was not {} within {}; the node is still at it (indurop status)",
                                      printable(module), past_of(command), human_age(timeout_ns))
                        : fmt::format("node '{}' has ended meanwhile", *node));
  return {kUnreachable};
}

}  // namespace indurop::tools
