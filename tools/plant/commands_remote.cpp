// SPDX-License-Identifier: Apache-2.0
// Commands to boards in the network, through their agents.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "deploy/link/command_link.h"
#include "deploy/words/command_words.h"
#include "keys/credentials.h"
#include "rt/clock.h"
#include "tools/command/interrupt.h"
#include "tools/command/suggest.h"
#include "tools/command/units.h"
#include "tools/plant/board_roster.h"
#include "tools/plant/commands.h"
#include "tools/plant/run_deployment.h"

namespace indurop::tools {
namespace {

using deploy::Action;
using deploy::Outcome;
using scheduler::ModuleCommand;

constexpr std::int64_t kRepeatNs = 200'000'000;
constexpr std::int64_t kHearNs = 5'000'000'000;

Action action_of(ModuleCommand what, bool module) {
  switch (what) {
    case ModuleCommand::Stop:
      return module ? Action::StopModule : Action::StopNode;
    case ModuleCommand::Start:
      return module ? Action::StartModule : Action::StartNode;
    case ModuleCommand::None:
    case ModuleCommand::Restart:
      break;
  }
  return module ? Action::RestartModule : Action::RestartNode;
}

std::string name_of(const CommandTarget& target) {
  return target.module.empty() ? fmt::format("the node of board {}", target.board)
                               : fmt::format("{}@{}", target.module, target.board);
}

class Commander {
 public:
  Commander(Context& context, deploy::DeployLink& link, deploy::CommandLink& commands, std::string key)
      : context_(context), link_(link), commands_(commands), key_(std::move(key)) {}

  int run(ModuleCommand what, const CommandTarget& target, deploy::Command command, std::int64_t timeout_ns) {
    const std::int64_t begin = rt::now_ns();
    std::int64_t say_ns = 0;
    while (!interrupted() && rt::now_ns() < begin + timeout_ns) {
      if (rt::now_ns() >= say_ns) {
        commands_.send(command);
        say_ns = rt::now_ns() + kRepeatNs;
      }
      link_.wait(rt::mono_time(std::min(say_ns, begin + timeout_ns)));
      for (const deploy::CommandReply& reply : commands_.take_replies()) {
        if (reply.commander != command.commander || reply.agent != command.agent) {
          continue;
        }
        if (reply.outcome == Outcome::Nonce && !taken_) {
          command.nonce = reply.nonce;
          command.signature = key_.empty() ? "" : keys::signature_of(deploy::command_text(command), key_);
          say_ns = 0;
        } else if (reply.nonce == command.nonce && reply.outcome == Outcome::UnderWay) {
          taken_ = true;
        } else if (reply.nonce == command.nonce && reply.outcome != Outcome::Nonce) {
          return conclude(what, target, reply, rt::now_ns() - begin);
        }
      }
    }
    if (interrupted()) {
      return interrupt_code();
    }
    context_.out.error(fmt::format("{} was not {} within {}{}", name_of(target), past_of(what), human_age(timeout_ns),
                                   taken_
                                       ? "; the board is still at it"
                                       : ": its agent did not answer; agents of older releases do not know commands"));
    return kUnreachable;
  }

 private:
  int conclude(ModuleCommand what, const CommandTarget& target, const deploy::CommandReply& reply,
               std::int64_t took_ns) {
    if (reply.outcome == Outcome::Done) {
      context_.out.note(fmt::format("{} {} after {}", name_of(target), past_of(what), human_ns(took_ns)));
      return kOk;
    }
    if (reply.outcome == Outcome::Unchanged) {
      context_.out.note(
          fmt::format("{} {} already", name_of(target), what == ModuleCommand::Stop ? "is stopped" : "runs"));
      return kOk;
    }
    context_.out.error(fmt::format("{} was not {}: {}", name_of(target), past_of(what), printable(reply.text)));
    return kFailed;
  }

  Context& context_;
  deploy::DeployLink& link_;
  deploy::CommandLink& commands_;
  std::string key_;
  bool taken_ = false;
};

// Names the boards that are not there, or are there twice; fails then.
Result<void, Failure> all_there(Context& context, const BoardRoster& roster,
                                const std::vector<CommandTarget>& targets) {
  std::vector<std::string> heard;
  for (const auto& [key, entry] : roster.all()) {
    heard.push_back(key.first);
  }
  int code = kOk;
  for (const CommandTarget& target : targets) {
    if (roster.find(target.board) == nullptr) {
      context.out.error(fmt::format(
          "board {} was not heard within {}.{} Boards heard: {}; a node of this machine is meant with --node",
          target.board, human_age(kHearNs), did_you_mean(target.board, heard),
          heard.empty() ? "none" : fmt::format("{}", fmt::join(heard, ", "))));
      code = kUnreachable;
    } else if (const std::string hosts = roster.twins(target.board, rt::now_ns()); !hosts.empty()) {
      context.out.error(fmt::format("two agents call themselves {}, on {}; stop one of them", target.board, hosts));
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
  std::string key;
  if (!options.keys.empty()) {
    auto read = read_deploy_key(context, options.keys);
    if (!read) {
      context.out.error(read.error().text);
      return kFailed;
    }
    key = std::move(read).value();
  }
  auto link = open_link(context, options.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  const auto commands = deploy::CommandLink::open(*link, deploy::CommandSide::Commander);
  if (!commands) {
    context.out.error(commands.error().text);
    return kFailed;
  }
  BoardRoster roster;
  roster.gather(*link, std::min(options.timeout_ns, kHearNs), [&] {
    return std::all_of(targets.begin(), targets.end(),
                       [&](const CommandTarget& target) { return roster.find(target.board) != nullptr; });
  });
  if (interrupted()) {
    return interrupt_code();
  }
  if (const auto there = all_there(context, roster, targets); !there) {
    return report(context.out, there.error());
  }
  for (const CommandTarget& target : targets) {
    const deploy::BoardReport& board = roster.find(target.board)->report;
    deploy::Command command;
    command.commander = options.link.self;
    command.host = deploy::host_name();
    command.board = target.board;
    command.agent = board.agent;
    command.plant = board.plant;
    command.action = action_of(what, !target.module.empty());
    command.module = target.module;
    if (const int code = Commander(context, *link, **commands, key).run(what, target, command, options.timeout_ns);
        code != kOk) {
      return code;
    }
  }
  return kOk;
}

}  // namespace indurop::tools
