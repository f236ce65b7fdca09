// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_forces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "control/plc/st/value_literal.h"
#include "deploy/transaction/write_words.h"
#include "store/operate/set.h"
#include "store/vars/custody.h"
#include "store/vars/store.h"

namespace indurop::deploy {
namespace {

using base::Problem;
using Done = Result<void, Problem>;

Problem problem(const std::vector<std::string>& reasons) {
  return {fmt::format("{}", fmt::join(reasons, "; "))};
}

Done done(const Result<void, operate::Refusal>& result) {
  return result ? Done() : Problem{result.error().text()};
}

operate::Who who(const Command& command, const WriteOrder& order) {
  return {user_of(order), command.host, order.reason};
}

Done unforce(const std::string& board, const WriteOrder& order, vars::Store& store, const operate::Who& who) {
  const auto items = operate::select(store, order.lines);
  if (!items) {
    return problem(items.error());
  }
  const auto released =
      order.lines.empty() ? operate::release_all(board, store, who) : operate::release(board, store, *items, who);
  return released ? Done() : Problem{released.error().text()};
}

Done set_lock(const std::string& board, const WriteOrder& order, const operate::Who& who) {
  const auto lock = order.lines.size() == 1 ? vars::write_lock_of(order.lines[0]) : std::nullopt;
  return lock ? done(operate::set_lock(board, *lock, who)) : Problem{"a write lock is none, tune or all"};
}

}  // namespace

Done BoardForces::carry_out(const Command& command, const std::string& user) {
  const auto order = parse_write_order(command.target);
  const bool renewal = order && order->renew && command.action == Action::Force;
  const bool bare = command.action == Action::Unforce || renewal;
  if (!order || (order->lines.empty() && !bare)) {
    return Problem{"the command cannot be understood"};
  }
  const operate::Who by = who(command, *order);
  if (command.action == Action::SetLock) {
    return set_lock(board_, *order, by);
  }
  if (renewal) {
    return renew(command, *order, user);
  }
  auto store = vars::Store::attach(board_, vars::Mode::ReadWrite);
  if (!store) {
    return Problem{fmt::format("its variables cannot be opened: {}", store.error().where)};
  }
  if (command.action == Action::Unforce) {
    return unforce(board_, *order, *store, by);
  }
  const auto all = operate::parse_all(*store, order->lines, &plc::read_value_literal);
  if (!all) {
    return problem(all.error());
  }
  if (command.action == Action::Set) {
    return done(operate::set(board_, *store, *all, by));
  }
  auto held = operate::hold(board_, *store, *all, order->for_ns,
                            order->lease ? operate::Ends::UnlessRenewed : operate::Ends::AtTime, by);
  if (!held) {
    return Problem{held.error().text()};
  }
  if (order->lease) {
    std::erase_if(leases_, [&](const auto& one) {
      return one.second.store.retired() || one.second.lease.until < one.second.store.now();
    });
    leases_.insert_or_assign(command.commander, Held{std::move(held).value(), by, user, std::move(store).value()});
  }
  return {};
}

// Renewal is allowed under a write lock too: values that are already forced stay forced.
Done BoardForces::renew(const Command& command, const WriteOrder& order, const std::string& user) {
  const auto found = leases_.find(command.commander);
  if (found == leases_.end() || found->second.store.retired()) {
    leases_.erase(command.commander);
    return Problem{"this lease no longer exists"};
  }
  Held& held = found->second;
  if (held.user != user) {
    return Problem{"this lease is that of another user"};
  }
  if (!order.end) {
    return done(operate::renew(held.lease, held.store, order.for_ns));
  }
  operate::end(board_, held.store, held.lease, held.who);
  leases_.erase(found);
  return {};
}

std::string locked_against_commands(const std::string& board) {
  const auto locked = operate::refusal(board, vars::Act::Command);
  return locked ? locked->text() : "";
}

}  // namespace indurop::deploy
