// SPDX-License-Identifier: Apache-2.0
// Orders to boards in the network, through their agents.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "deploy/command_words.h"
#include "deploy/credentials.h"
#include "mirror/command_link.h"
#include "rt/clock.h"
#include "tools/board_roster.h"
#include "tools/interrupt.h"
#include "tools/orders.h"
#include "tools/run_deployment.h"
#include "tools/suggest.h"
#include "tools/units.h"

namespace indurop::tools {
namespace {

using deploy::Action;
using deploy::Outcome;
using scheduler::ModuleOrder;

constexpr std::int64_t kRepeatNs = 200'000'000;
constexpr std::int64_t kHearNs = 5'000'000'000;

Action action_of(ModuleOrder order, bool module) {
  switch (order) {
    case ModuleOrder::Stop:
      return module ? Action::StopModule : Action::StopNode;
    case ModuleOrder::Start:
      return module ? Action::StartModule : Action::StartNode;
    case ModuleOrder::None:
    case ModuleOrder::Restart:
      break;
  }
  return module ? Action::RestartModule : Action::RestartNode;
}

std::string name_of(const OrderTarget& target) {
  return target.module.empty() ? fmt::format("the node of board {}", target.board)
                               : fmt::format("{}@{}", target.module, target.board);
}

class Commander {
 public:
  Commander(Context& context, mirror::DeployLink& link, mirror::CommandLink& commands, std::string key)
      : context_(context), link_(link), commands_(commands), key_(std::move(key)) {}

  int run(ModuleOrder order, const OrderTarget& target, deploy::Command command, std::int64_t timeout_ns) {
    const std::int64_t begin = rt::now_ns();
    std::int64_t say_ns = 0;
    while (!interrupted() && rt::now_ns() < begin + timeout_ns) {
      if (rt::now_ns() >= say_ns) {
        commands_.send(command);
        say_ns = rt::now_ns() + kRepeatNs;
      }
      link_.wait(std::min(say_ns, begin + timeout_ns));
      for (const deploy::CommandReply& reply : commands_.take_replies()) {
        if (reply.commander != command.commander || reply.agent != command.agent) {
          continue;
        }
        if (reply.outcome == Outcome::Nonce && !taken_) {
          command.nonce = reply.nonce;
          command.signature = key_.empty() ? "" : deploy::signature_of(deploy::command_text(command), key_);
          say_ns = 0;
        } else if (reply.nonce == command.nonce && reply.outcome == Outcome::UnderWay) {
          taken_ = true;
        } else if (reply.nonce == command.nonce && reply.outcome != Outcome::Nonce) {
          return conclude(order, target, reply, rt::now_ns() - begin);
        }
      }
    }
    if (interrupted()) {
      return interrupt_code();
    }
    context_.out.error(fmt::format(
        "{} was not {} within {}{}", name_of(target), past_of(order), human_age(timeout_ns),
        taken_ ? "; the board is still at it" : ": its agent did not answer; one of an older release knows no orders"));
    return kUnreachable;
  }

 private:
  int conclude(ModuleOrder order, const OrderTarget& target, const deploy::CommandReply& reply, std::int64_t took_ns) {
    if (reply.outcome == Outcome::Done) {
      context_.out.note(fmt::format("{} {} after {}", name_of(target), past_of(order), human_ns(took_ns)));
      return kOk;
    }
    if (reply.outcome == Outcome::Unchanged) {
      context_.out.note(
          fmt::format("{} {} already", name_of(target), order == ModuleOrder::Stop ? "is stopped" : "runs"));
      return kOk;
    }
    context_.out.error(fmt::format("{} was not {}: {}", name_of(target), past_of(order), printable(reply.text)));
    return kFailed;
  }

  Context& context_;
  mirror::DeployLink& link_;
  mirror::CommandLink& commands_;
  std::string key_;
  bool taken_ = false;
};

// Names the boards that are not there, or are there twice. False if it said something.
bool all_there(Context& context, const BoardRoster& roster, const std::vector<OrderTarget>& targets, int& code) {
  std::vector<std::string> heard;
  for (const auto& [key, entry] : roster.all()) {
    heard.push_back(key.first);
  }
  bool good = true;
  for (const OrderTarget& target : targets) {
    if (roster.find(target.board) == nullptr) {
      context.out.error(fmt::format(
          "board {} was not heard within {}.{} Boards heard: {}; a node of this machine is meant with --node",
          target.board, human_age(kHearNs), did_you_mean(target.board, heard),
          heard.empty() ? "none" : fmt::format("{}", fmt::join(heard, ", "))));
      code = kUnreachable;
      good = false;
    } else if (const std::string hosts = roster.twins(target.board, rt::now_ns()); !hosts.empty()) {
      context.out.error(fmt::format("two agents call themselves {}, on {}; stop one of them", target.board, hosts));
      code = kFailed;
      good = false;
    }
  }
  return good;
}

}  // namespace

int order_afar(Context& context, ModuleOrder order, const std::vector<OrderTarget>& targets, OrderOptions& options) {
  std::string key;
  if (!options.keys.empty() && !read_deploy_key(context, options.keys, key)) {
    return kFailed;
  }
  auto link = open_link(context, options.link);
  if (link == nullptr) {
    return kUnreachable;
  }
  std::string problem;
  const auto commands = mirror::CommandLink::open(*link, mirror::CommandSide::Commander, problem);
  if (commands == nullptr) {
    context.out.error(problem);
    return kFailed;
  }
  BoardRoster roster;
  roster.gather(*link, std::min(options.timeout_ns, kHearNs), [&] {
    return std::all_of(targets.begin(), targets.end(),
                       [&](const OrderTarget& target) { return roster.find(target.board) != nullptr; });
  });
  int code = kOk;
  if (interrupted()) {
    return interrupt_code();
  }
  if (!all_there(context, roster, targets, code)) {
    return code;
  }
  for (const OrderTarget& target : targets) {
    const deploy::BoardReport& board = roster.find(target.board)->report;
    deploy::Command command;
    command.commander = options.link.self;
    command.host = mirror::host_name();
    command.board = target.board;
    command.agent = board.agent;
    command.plant = board.plant;
    command.action = action_of(order, !target.module.empty());
    command.module = target.module;
    if (code = Commander(context, *link, *commands, key).run(order, target, command, options.timeout_ns); code != kOk) {
      return code;
    }
  }
  return kOk;
}

}  // namespace indurop::tools
