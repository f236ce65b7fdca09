// SPDX-License-Identifier: Apache-2.0
#include "tools/client/board/lease_keeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/rt/clock.h"
#include "core/rt/signal_word.h"
#include "deploy/transaction/write_words.h"
#include "tools/client/board/deploy_key.h"
#include "tools/client/messages.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kRenewNs = LeaseKeeper::kLeaseNs / 4;
constexpr std::int64_t kAnswerNs = 5'000'000'000;  // how long the answer to a force is awaited

std::string force_target(const PlantWatch::RemoteOrder& order) {
  deploy::WriteOrder words;
  words.for_ns = LeaseKeeper::kLeaseNs;
  words.lease = true;
  words.who = order.who;
  words.reason = order.reason;
  words.lines = order.lines;
  return text_of(words);
}

std::string renewal_target(bool ends) {
  deploy::WriteOrder words;
  words.for_ns = LeaseKeeper::kLeaseNs;
  words.renew = true;
  words.end = ends;
  return text_of(words);
}

}  // namespace

Result<std::unique_ptr<LeaseKeeper>, Failure> LeaseKeeper::open(deploy::LinkSettings settings) {
  CommandKey key;
  if (!settings.keys.empty()) {
    KeptMessages ignored;
    auto read = read_command_key(ignored, settings.keys);
    if (!read) {
      return Failure{kFailed, read.error().text};
    }
    key = std::move(read).value();
  }
  settings.self = deploy::new_session();
  auto opened = deploy::DeployLink::open(settings);
  if (!opened) {
    return Failure{kUnreachable, opened.error().text};
  }
  auto commands = deploy::CommandLink::open(*opened->link, deploy::CommandSide::Commander);
  if (!commands) {
    return Failure{kUnreachable, commands.error().text};
  }
  return std::unique_ptr<LeaseKeeper>(
      new LeaseKeeper(std::move(opened->link), std::move(commands).value(), std::move(key)));
}

void LeaseKeeper::begin(Lease& lease, std::string target, std::int64_t now_ns) const {
  lease.command.target = std::move(target);
  lease.exchange.emplace(lease.command, key_);
  lease.begun_ns = now_ns;
}

void LeaseKeeper::run() {
  constexpr std::int64_t kIdleNs = 500'000'000;
  while (!stopped_.load()) {
    std::int64_t next_ns = rt::now_ns() + kIdleNs;
    {
      const std::lock_guard guard(mutex_);
      const std::int64_t now = rt::now_ns();
      for (auto one = leases_.begin(); one != leases_.end();) {
        const auto next = step(one->second, now);
        next_ns = std::min(next_ns, next.value_or(next_ns));
        one = next ? std::next(one) : leases_.erase(one);
      }
    }
    link_->wait(rt::mono_time(next_ns));
    // Reports of boards are not evaluated here, but must not pile up.
    (void)link_->take_boards();
    const auto replies = commands_->take_replies();
    const std::lock_guard guard(mutex_);
    for (const deploy::CommandReply& reply : replies) {
      const auto found = leases_.find(reply.commander);
      if (found != leases_.end() && found->second.exchange && found->second.exchange->take(reply)) {
        receive(found->second, reply);
      }
    }
  }
}

void LeaseKeeper::stop() {
  stopped_.store(true);
  link_->wake_word().wake();
}

std::optional<std::int64_t> LeaseKeeper::step(Lease& lease, std::int64_t now_ns) const {
  if (lease.stage != Stage::Taking && now_ns >= lease.until_ns) {
    return std::nullopt;
  }
  const std::int64_t renew_ns = lease.begun_ns + kRenewNs;
  if (!lease.exchange && lease.stage == Stage::Ending) {
    begin(lease, renewal_target(true), now_ns);
  } else if (!lease.exchange && lease.stage == Stage::Held && now_ns >= renew_ns) {
    begin(lease, renewal_target(false), now_ns);
  }
  if (!lease.exchange) {
    return lease.stage == Stage::Held ? renew_ns : now_ns + kRenewNs;
  }
  if (now_ns >= lease.exchange->due_ns()) {
    commands_->send(lease.exchange->command());
    lease.exchange->sent(now_ns);
  }
  return lease.exchange->due_ns();
}

// An end is not begun before the renewal is answered that was sent: the agent would take one for the other.
void LeaseKeeper::receive(Lease& lease, const deploy::CommandReply& reply) {
  const bool done = reply.outcome == deploy::Outcome::Done;
  const bool ended = lease.exchange->command().target == renewal_target(true);
  lease.exchange.reset();
  lease.until_ns = done && !ended ? lease.begun_ns + kLeaseNs : 0;
  if (lease.stage == Stage::Taking) {
    lease.answer = reply;
    answered_.notify_all();
  }
}

Result<std::uint64_t, Failure> LeaseKeeper::take(const deploy::BoardReport& board,
                                                 const PlantWatch::RemoteOrder& order) {
  const std::int64_t patience_ns = kAnswerNs + link_->letting_in_ns();
  std::unique_lock guard(mutex_);
  const auto of_board = std::count_if(leases_.begin(), leases_.end(),
                                      [&](const auto& one) { return one.second.command.board == board.board; });
  if (static_cast<std::size_t>(of_board) >= kMaxOfBoard) {
    return Failure{kFailed, fmt::format("board {}: {} forces with a lease are held already; end one, or force several "
                                        "values at once",
                                        board.board, of_board)};
  }
  std::uint64_t number = deploy::new_session();
  while (leases_.contains(number)) {
    ++number;
  }
  Lease& lease = leases_[number];
  lease.command = {number, deploy::host_name(), board.board, board.agent, board.plant, deploy::Action::Force, {}, 0,
                   {}};
  begin(lease, force_target(order), rt::now_ns());
  link_->wake_word().wake();
  answered_.wait_for(guard, std::chrono::nanoseconds(patience_ns), [&] { return lease.answer.has_value(); });
  if (!lease.answer) {
    // The board may carry it out yet.
    lease.exchange.reset();
    lease.stage = Stage::Ending;
    lease.until_ns = rt::now_ns() + kLeaseNs;
    return Failure{kUnreachable,
                   fmt::format("board {}: its agent did not answer within {}", board.board, human_age(patience_ns))};
  }
  if (lease.answer->outcome != deploy::Outcome::Done) {
    Failure refused{kFailed, fmt::format("board {}: {}", board.board, printable(lease.answer->text))};
    leases_.erase(number);
    return refused;
  }
  lease.stage = Stage::Held;
  return number;
}

bool LeaseKeeper::holds(std::uint64_t lease) const {
  const std::lock_guard guard(mutex_);
  const auto found = leases_.find(lease);
  return found != leases_.end() && found->second.stage == Stage::Held && rt::now_ns() < found->second.until_ns;
}

void LeaseKeeper::end(std::uint64_t lease) {
  const std::lock_guard guard(mutex_);
  if (const auto found = leases_.find(lease); found != leases_.end()) {
    found->second.stage = Stage::Ending;
    link_->wake_word().wake();
  }
}

}  // namespace indurop::tools
