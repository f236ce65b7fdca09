// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/module_command.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <vector>

#include "core/rt/clock.h"
#include "store/operate/journal.h"
#include "store/operate/set.h"
#include "tools/client/node/node_choice.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/suggest.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using scheduler::CommandResult;
using scheduler::ModuleCommand;

constexpr std::int64_t kPollNs = 2'000'000;

Result<Commanded, Failure> conclude(ModuleCommand command, const scheduler::ModuleRecord& record, CommandResult result,
                                    std::int64_t took_ns) {
  const std::string module = printable(fixed_text(record.name));
  switch (result) {
    case CommandResult::Done:
      return Commanded{result, took_ns,
                       fmt::format("module '{}' {} after {}", module, past_of(command), human_ns(took_ns))};
    case CommandResult::OldCode:
      return Commanded{result, took_ns,
                       fmt::format("module '{}' {}, with the code that was loaded when the node started: its file "
                                   "is another one now. Stop and run the node to load it",
                                   module, past_of(command))};
    case CommandResult::Unchanged:
      return Commanded{
          result, took_ns,
          fmt::format("module '{}' {} already", module, command == ModuleCommand::Stop ? "is stopped" : "runs")};
    case CommandResult::Ending:
      return Failure{kUnreachable,
                     fmt::format("module '{}' was not {}: the node itself ends", module, past_of(command))};
    case CommandResult::Failed:
    case CommandResult::Refused:
    case CommandResult::None:
      break;
  }
  const std::string why = printable(fixed_text(record.last_fault));
  return Failure{kFailed,
                 fmt::format("module '{}' could not be {}{}", module, past_of(command), why.empty() ? "" : ": " + why)};
}

Result<RunView, Failure> open_running(const std::string& node, ModuleCommand command) {
  auto run = RunView::open(node, vars::Mode::ReadWrite);
  if (!run.ok()) {
    return Failure{exit_code_of(run.error()), run.error().code == Errc::NotFound
                                                  ? fmt::format("node '{}' does not run", node)
                                                  : explain_open_error(run.error(), node, true)};
  }
  if (!run->node_alive() || run->block().state.load() != scheduler::NodeState::Running) {
    return Failure{kUnreachable,
                   fmt::format("node '{}' does not run, so there is no module to be {}", node, past_of(command))};
  }
  return std::move(run).value();
}

}  // namespace

Result<std::uint32_t, Failure> find_module(const RunView& run, const std::string& node, const std::string& module) {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < run.module_count(); ++i) {
    names.push_back(fixed_text(run.module(i).name));
    if (names.back() == module) {
      return i;
    }
  }
  return Failure{kFailed, fmt::format("node '{}' has no module '{}'.{} indurop status lists them", node,
                                      printable(module), did_you_mean(module, names))};
}

const char* verb_of(ModuleCommand command) {
  switch (command) {
    case ModuleCommand::Stop:
      return "stop";
    case ModuleCommand::Start:
      return "start";
    case ModuleCommand::Reload:
      return "reload";
    case ModuleCommand::Back:
      return "reload --back";
    case ModuleCommand::Schedule:
      return "reload --config";
    case ModuleCommand::None:
    case ModuleCommand::Exchange:
    case ModuleCommand::Restart:
      break;
  }
  return "restart";
}

const char* past_of(ModuleCommand command) {
  switch (command) {
    case ModuleCommand::Stop:
      return "stopped";
    case ModuleCommand::Start:
      return "started";
    case ModuleCommand::Reload:
    case ModuleCommand::Back:
    case ModuleCommand::Exchange:
      return "exchanged";
    case ModuleCommand::Schedule:
      return "rescheduled";
    case ModuleCommand::None:
    case ModuleCommand::Restart:
      break;
  }
  return "restarted";
}

Result<CommandAnswer, Failure> await_answer(const std::string& node, ModuleCommand command, const std::string& module,
                                            std::int64_t timeout_ns) {
  auto run = open_running(node, command);
  if (!run) {
    return std::move(run).error();
  }
  if (const auto locked = operate::refusal(node, vars::Act::Command)) {
    return Failure{kFailed, fmt::format("node '{}': {}", node, locked->text())};
  }
  const auto index = find_module(*run, node, module);
  if (!index) {
    return index.error();
  }
  scheduler::ModuleRecord& record = run->module_to_command(*index);
  const std::int64_t begin = rt::now_ns();
  std::optional<scheduler::CommandTicket> ticket;
  while (rt::now_ns() < begin + timeout_ns && !interrupted() && run->node_alive()) {
    if (!ticket) {
      ticket = scheduler::place_command(record, command);
    } else if (const auto result = scheduler::result_of(record, *ticket); result != CommandResult::None) {
      return CommandAnswer{std::move(run).value(), &record, result, rt::now_ns() - begin};
    }
    wait_until(rt::now_ns() + kPollNs);
  }
  if (interrupted()) {
    return Failure{interrupt_code(), {}};
  }
  return Failure{kUnreachable,
                 run->node_alive()
                     ? fmt::format("module '{}' was not {} within {}; the node is still working on it (indurop status)",
                                   printable(module), past_of(command), human_age(timeout_ns))
                     : fmt::format("node '{}' has ended meanwhile", node)};
}

void note_command(const std::string& node, const RunView& run, ModuleCommand command, const std::string& module,
                  const std::string& value, const operate::Who& who) {
  const std::int64_t simulated = run.block().virtual_ns.load();
  operate::note(node, {simulated != 0 ? simulated : rt::now_ns(), 0, who.name, who.from, verb_of(command), module,
                       value, 0, who.reason});
}

Result<Commanded, Failure> command_module(const std::string& node, ModuleCommand command, const std::string& module,
                                          std::int64_t timeout_ns, const operate::Who& who) {
  const auto answer = await_answer(node, command, module, timeout_ns);
  if (!answer) {
    return answer.error();
  }
  if (answer->result == CommandResult::Done || answer->result == CommandResult::OldCode) {
    note_command(node, answer->run, command, module, "", who);
  }
  return conclude(command, *answer->record, answer->result, answer->took_ns);
}

}  // namespace indurop::tools
