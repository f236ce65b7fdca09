// SPDX-License-Identifier: Apache-2.0
// Commands to boards in the network, through their agents.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "deploy/transaction/write_words.h"
#include "deploy/words/command_words.h"
#include "tools/cli/plant/commands.h"
#include "tools/client/board/board_commander.h"
#include "tools/client/board/board_roster.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/suggest.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using deploy::Action;
using deploy::Outcome;
using scheduler::ModuleCommand;

constexpr std::int64_t kTargetDiscoverNs = 5'000'000'000;

Action action_of(ModuleCommand what, bool module) {
  switch (what) {
    case ModuleCommand::Stop:
      return module ? Action::StopModule : Action::StopNode;
    case ModuleCommand::Start:
      return module ? Action::StartModule : Action::StartNode;
    case ModuleCommand::None:
    case ModuleCommand::Restart:
    case ModuleCommand::Reload:
    case ModuleCommand::Back:
    case ModuleCommand::Exchange:  // of this machine only
    case ModuleCommand::Schedule:
      break;
  }
  return module ? Action::RestartModule : Action::RestartNode;
}

std::string name_of(const CommandTarget& target) {
  return target.module.empty() ? fmt::format("the node of board {}", target.board)
                               : fmt::format("{}@{}", target.module, target.board);
}

int conclude(Context& context, ModuleCommand what, const CommandTarget& target, const Answered& answered) {
  const deploy::CommandReply& reply = answered.reply;
  if (reply.outcome == Outcome::Done) {
    context.out.note(fmt::format("{} {} after {}{}{}", name_of(target), past_of(what), human_ns(answered.took_ns),
                                 reply.text.empty() ? "" : "; ", printable(reply.text)));
    return kOk;
  }
  if (reply.outcome == Outcome::Unchanged) {
    context.out.note(
        fmt::format("{} {} already", name_of(target), what == ModuleCommand::Stop ? "is stopped" : "runs"));
    return kOk;
  }
  context.out.error(fmt::format("{} was not {}: {}", name_of(target), past_of(what), printable(reply.text)));
  return kFailed;
}

// Fails if boards are missing or have the same name, and names them.
Result<void, Failure> all_there(Context& context, const BoardRoster& roster, const std::vector<CommandTarget>& targets,
                                const std::string& keys) {
  std::vector<std::string> discovered;
  for (const auto& [key, entry] : roster.all()) {
    discovered.push_back(key.first);
  }
  int code = kOk;
  for (const CommandTarget& target : targets) {
    if (roster.find(target.board) == nullptr) {
      context.out.error(fmt::format(
          "board {} was not heard within {}.{} Boards heard: {}; a node of this machine is meant with --node{}",
          target.board, human_age(kTargetDiscoverNs), did_you_mean(target.board, discovered),
          discovered.empty() ? "none" : fmt::format("{}", fmt::join(discovered, ", ")),
          discovered.empty() ? keys : ""));
      code = kUnreachable;
    } else if (const std::string hosts = roster.twins(target.board, rt::now_ns()); !hosts.empty()) {
      context.out.error(fmt::format("two agents are named {}, on {}; stop one of them", target.board, hosts));
      code = kFailed;
    }
  }
  if (code != kOk) {
    return Failure{code, {}};
  }
  return {};
}

}  // namespace

int command_remote(Context& context, ModuleCommand what, const std::vector<CommandTarget>& targets,
                   CommandOptions& options) {
  auto commander = BoardCommander::make(context.out, options.link.keys);
  if (!commander) {
    return report(context.out, commander.error());
  }
  auto link = open_link(context.out, options.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  BoardRoster roster;
  roster.gather(*link, std::min(options.timeout_ns, kTargetDiscoverNs), [&] {
    return std::all_of(targets.begin(), targets.end(),
                       [&](const CommandTarget& target) { return roster.find(target.board) != nullptr; });
  });
  if (interrupted()) {
    return interrupt_code();
  }
  if (const auto there = all_there(context, roster, targets, keys_hint(options.link)); !there) {
    return report(context.out, there.error());
  }
  deploy::WriteOrder words;
  words.who = base::user_name();
  words.reason = context.reason;
  for (const CommandTarget& target : targets) {
    const deploy::BoardReport& board = roster.find(target.board)->report;
    words.lines.assign(target.module.empty() ? 0 : 1, target.module);
    const auto answered = commander->send(*link, options.link.self, board, action_of(what, !target.module.empty()),
                                          deploy::module_target(words, board.release), options.timeout_ns);
    if (!answered) {
      context.out.error(fmt::format("{} was not {}: {}", name_of(target), past_of(what), answered.error().text));
      return answered.error().code;
    }
    if (const int code = conclude(context, what, target, *answered); code != kOk) {
      return code;
    }
  }
  return kOk;
}

}  // namespace indurop::tools
