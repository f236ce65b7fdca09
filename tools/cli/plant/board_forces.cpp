// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plant/board_forces.h"

#include <fmt/format.h>

#include <optional>

#include "core/base/user_name.h"
#include "core/rt/clock.h"
#include "deploy/transaction/write_words.h"
#include "tools/client/board/board_commander.h"
#include "tools/client/process/interrupt.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kForcePatienceNs = 5'000'000'000;
// An agent may need a moment to receive a renewal.
constexpr std::int64_t kRemoteLeaseNs = 5'000'000'000;

// Sends commands to one board, one after the other.
class Orders {
 public:
  Orders(Context& context, BoardForces& options) : context_(context), options_(options) {}

  // Returns the exit code, after a message if it is not kOk.
  int send(deploy::Action action, const std::string& target) {
    if (!commander_) {
      auto made = BoardCommander::make(context_.out, options_.board.link.keys);
      if (!made) {
        return report(context_.out, made.error());
      }
      commander_ = std::move(made).value();
    }
    const auto board = find_board(context_, options_.board);
    if (!board) {
      return report(context_.out, board.error());
    }
    const deploy::BoardReport& there = (*board)->report;
    const auto answered =
        commander_->send(*options_.board.open, options_.board.link.self, there, action, target, kForcePatienceNs);
    if (!answered) {
      context_.out.error(fmt::format("board {}: {}", there.board, answered.error().text));
      return answered.error().code;
    }
    if (answered->reply.outcome != deploy::Outcome::Done) {
      context_.out.error(fmt::format("board {}: {}", there.board, printable(answered->reply.text)));
      return kFailed;
    }
    return kOk;
  }

 private:
  Context& context_;
  BoardForces& options_;
  std::optional<BoardCommander> commander_;
};

deploy::WriteOrder order_of(const Context& context, std::vector<std::string> lines) {
  deploy::WriteOrder order;
  order.who = base::user_name();
  order.reason = context.reason;
  order.lines = std::move(lines);
  return order;
}

std::vector<std::string> as_lines(std::vector<std::string> assignments) {
  if (assignments.size() == 2 && assignments[0].find('=') == std::string::npos) {
    return {assignments[0] + "=" + assignments[1]};
  }
  return assignments;
}

}  // namespace

void add_board_force_options(base::Options& app, BoardForces& options) {
  add_board_options(app, options.board);
}

int force_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments, std::int64_t for_ns) {
  deploy::WriteOrder order = order_of(context, as_lines(std::move(assignments)));
  order.for_ns = for_ns;
  return Orders(context, options).send(deploy::Action::Force, text_of(order));
}

int set_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments) {
  return Orders(context, options)
      .send(deploy::Action::Set, text_of(order_of(context, as_lines(std::move(assignments)))));
}

int hold_on_board(Context& context, BoardForces& options, std::vector<std::string> assignments) {
  Orders orders(context, options);
  deploy::WriteOrder order = order_of(context, as_lines(std::move(assignments)));
  order.for_ns = kRemoteLeaseNs;
  order.lease = true;
  if (const int code = orders.send(deploy::Action::Force, text_of(order)); code != kOk) {
    return code;
  }
  context.out.note("held while this command runs; Ctrl-C releases");
  deploy::WriteOrder again;
  again.for_ns = kRemoteLeaseNs;
  again.renew = true;
  while (wait_until(rt::now_ns() + kRemoteLeaseNs / 4) != Woken::Signal) {
    if (const int code = orders.send(deploy::Action::Force, text_of(again)); code != kOk) {
      return interrupted() ? kOk : code;
    }
  }
  take_interrupt();
  again.end = true;
  return orders.send(deploy::Action::Force, text_of(again));
}

int lock_board(Context& context, BoardForces& options, const std::string& word) {
  return Orders(context, options).send(deploy::Action::SetLock, text_of(order_of(context, {word})));
}

int unforce_on_board(Context& context, BoardForces& options, const std::vector<std::string>& names) {
  return Orders(context, options).send(deploy::Action::Unforce, text_of(order_of(context, names)));
}

}  // namespace indurop::tools
