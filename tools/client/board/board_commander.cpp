// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/board_commander.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/rt/clock.h"
#include "tools/client/board/command_exchange.h"
#include "tools/client/board/deploy_key.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kBusyPollNs = 1'000'000;

}  // namespace

Result<BoardCommander, Failure> BoardCommander::make(Messages& messages, const std::filesystem::path& keys) {
  if (keys.empty()) {
    return BoardCommander({});
  }
  auto key = read_command_key(messages, keys);
  if (!key) {
    return Failure{kFailed, key.error().text};
  }
  return BoardCommander(std::move(key).value());
}

Result<Answered, Failure> BoardCommander::send(deploy::DeployLink& link, std::uint64_t self,
                                               const deploy::BoardReport& board, deploy::Action action,
                                               const std::string& target, std::int64_t timeout_ns,
                                               const std::function<bool()>& meanwhile) {
  if (commands_ == nullptr) {
    auto opened = deploy::CommandLink::open(link, deploy::CommandSide::Commander);
    if (!opened) {
      return Failure{kUnreachable, opened.error().text};
    }
    commands_ = std::move(opened).value();
  }
  CommandExchange exchange({self, deploy::host_name(), board.board, board.agent, board.plant, action, target, 0, {}},
                           key_);
  const std::int64_t begin = rt::now_ns();
  bool busy = false;
  while (!interrupted() && rt::now_ns() < begin + timeout_ns) {
    if (rt::now_ns() >= exchange.due_ns()) {
      commands_->send(exchange.command());
      exchange.sent(rt::now_ns());
    }
    const std::int64_t next = busy ? rt::now_ns() + kBusyPollNs : begin + timeout_ns;
    link.wait(rt::mono_time(std::min(exchange.due_ns(), next)));
    busy = meanwhile && meanwhile();
    for (const deploy::CommandReply& reply : commands_->take_replies()) {
      if (exchange.take(reply)) {
        return Answered{reply, rt::now_ns() - begin};
      }
    }
  }
  if (interrupted()) {
    return Failure{interrupt_code(), "interrupted"};
  }
  return Failure{
      kUnreachable,
      fmt::format("{} within {}",
                  exchange.under_way() ? "the board is still working on it"
                                       : "its agent did not answer (agents of older releases do not know all commands)",
                  human_age(timeout_ns))};
}

}  // namespace indurop::tools
