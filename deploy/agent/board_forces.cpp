// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_forces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <utility>

#include "base/text.h"
#include "deploy/transaction/write_words.h"
#include "explain/orders.h"
#include "schema/schema.h"
#include "vars/custody.h"
#include "vars/held_value.h"
#include "vars/store.h"

namespace indurop::deploy {
namespace {

using base::Problem;
using Done = Result<void, Problem>;

struct Wanted {
  schema::Place place;
  vars::HeldValue value;
  std::string name;
  std::string text;
};

Result<vars::Store, Problem> open_store(const std::string& board) {
  auto store = vars::Store::attach(board, vars::Mode::ReadWrite);
  return store ? Result<vars::Store, Problem>(std::move(store).value())
               : Problem{fmt::format("its variables cannot be opened: {}", store.error().where)};
}

Result<Wanted, Problem> find(const vars::Store& store, const std::string& name) {
  std::string message;
  auto place = schema::find_place(store.schema(), name, message);
  if (!place) {
    return Problem{message.empty() ? fmt::format("there is no variable '{}'", name) : message};
  }
  const auto* entry = store.find(place->variable->name_hash());
  if (entry == nullptr) {
    return Problem{fmt::format("'{}' is not in use on this board", name)};
  }
  return Wanted{*place, {entry, place->offset, place->type, {}, {}}, name, {}};
}

Result<Wanted, Problem> read(const vars::Store& store, const std::string& assignment) {
  const auto equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  if (equals == std::string::npos) {
    return Problem{fmt::format("'{}' is not an assignment, write NAME=VALUE", assignment)};
  }
  auto wanted = find(store, name);
  if (!wanted) {
    return wanted;
  }
  wanted->text = assignment.substr(equals + 1);
  vars::HeldValue& value = wanted->value;
  value.bytes.resize(value.type.size());
  (void)store.read(*value.variable, value.offset, value.bytes);  // what the text leaves out stays as it is
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  std::string message;
  if (!schema::parse_value(value.type, wanted->text, value.bytes, message) ||
      !schema::check_range(wanted->place.range.value_or(schema::Range{-kUnlimited, kUnlimited}), value.type,
                           value.bytes, message)) {
    return Problem{fmt::format("{}: {}", name, message)};
  }
  value.parts = vars::parts_to_hold(value.type, wanted->text, value.bytes);
  return wanted;
}

Result<std::vector<Wanted>, Problem> read_all(const vars::Store& store, const std::vector<std::string>& lines) {
  std::vector<Wanted> all;
  std::vector<std::string> wrong;
  for (const std::string& line : lines) {
    auto one = read(store, line);
    if (one) {
      all.push_back(std::move(one).value());
    } else {
      wrong.push_back(one.error().text);
    }
  }
  if (!wrong.empty()) {
    return Problem{fmt::format("{}", fmt::join(wrong, "; "))};
  }
  return all;
}

std::vector<vars::HeldValue> values_of(const std::vector<Wanted>& all) {
  std::vector<vars::HeldValue> values;
  values.reserve(all.size());
  std::transform(all.begin(), all.end(), std::back_inserter(values), [](const Wanted& one) { return one.value; });
  return values;
}

std::string who(const WriteOrder& order) {
  return order.who.empty() ? "somebody" : order.who;
}

void note(const std::string& board, const Command& command, const WriteOrder& order, const char* action,
          const std::string& what, const std::string& value) {
  explain::note_order(board, {rt::now_ns(), 0, who(order), command.host, action, what, value, 0, order.reason});
}

// What `indurop forces` tells about them.
vars::ForceNote note_about(const Command& command, const WriteOrder& order) {
  vars::ForceNote about;
  about.who = who(order);
  about.from = command.host;
  about.reason = order.reason;
  about.wall_ns = rt::wall_ns();
  about.lease = order.lease;
  return about;
}

Done set(const std::string& board, const Command& command, const WriteOrder& order, vars::Store& store) {
  const auto all = read_all(store, order.lines);
  if (!all) {
    return all.error();
  }
  const bool tuning =
      std::all_of(all->begin(), all->end(), [](const Wanted& one) { return one.place.variable->given; });
  if (auto why = vars::refusal(vars::lock_of(board), tuning ? vars::Act::SetParameter : vars::Act::Set)) {
    return Problem{std::move(*why)};
  }
  for (const Wanted& one : *all) {
    const auto& value = one.value;
    for (const vars::Force& force : store.forces()) {
      if (force.variable == value.variable && force.offset < value.offset + value.type.size() &&
          force.offset + force.size > value.offset) {
        return Problem{fmt::format("{} is forced; let it go first: indurop unforce", one.name)};
      }
    }
  }
  for (const Wanted& one : *all) {
    // Read again: two orders may be about parts of one variable.
    std::vector<std::uint8_t> bytes(one.value.type.size());
    std::string message;
    (void)store.read(*one.value.variable, one.value.offset, bytes);
    (void)schema::parse_value(one.value.type, one.text, bytes, message);
    if (const Status written = store.write(*one.value.variable, one.value.offset, bytes); !written) {
      return Problem{fmt::format("{} is not set: {}", one.name, written.error().where)};
    }
    note(board, command, order, "set", one.name, one.text);
  }
  return {};
}

Done unforce(const std::string& board, const Command& command, vars::Store& store) {
  std::vector<Wanted> named;
  const bool everything = command.target == "*";
  for (const std::string& name : everything ? std::vector<std::string>() : base::lines_of(command.target)) {
    auto found = find(store, name);
    if (!found) {
      return found.error();
    }
    named.push_back(std::move(found).value());
  }
  for (const vars::Force& force : store.forces()) {
    const bool meant = everything || std::any_of(named.begin(), named.end(), [&](const Wanted& one) {
                         return force.variable == one.value.variable && force.offset >= one.value.offset &&
                                force.offset < one.value.offset + one.value.type.size();
                       });
    if (const Status gone = meant ? store.let_go(*force.variable, force.offset) : Status();
        !gone && gone.error().code != Errc::NotFound) {
      const schema::Variable& variable = store.schema().variables[force.variable->schema_index];
      return Problem{fmt::format("{} is still forced: {}", variable.name, gone.error().where)};
    }
  }
  for (const std::string& name : base::lines_of(command.target)) {
    note(board, command, {}, "unforce", name, {});
  }
  return {};
}

Done set_lock(const std::string& board, const Command& command, const WriteOrder& order) {
  const auto lock = order.lines.size() == 1 ? vars::write_lock_of(order.lines[0]) : std::nullopt;
  auto custody = vars::Custody::open(board, vars::Mode::ReadWrite);
  if (!lock || !custody) {
    return Problem{lock ? fmt::format("its write lock cannot be opened: {}", custody.error().where)
                        : "a write lock is none, tune or all"};
  }
  vars::LockNote about;
  about.who = who(order);
  about.from = command.host;
  about.reason = order.reason;
  about.wall_ns = rt::wall_ns();
  about.lock = *lock;
  if (const Status locked = custody->set_lock(about); !locked) {
    return Problem{fmt::format("it is not locked: {}", locked.error().where)};
  }
  note(board, command, order, "lock", order.lines[0], {});
  return {};
}

}  // namespace

Done BoardForces::carry_out(const Command& command) {
  const auto order = command.action == Action::Unforce ? WriteOrder() : parse_write_order(command.target);
  if (!order || (order->lines.empty() && !order->renew && command.action != Action::Unforce)) {
    return Problem{"the command cannot be understood"};
  }
  if (command.action == Action::SetLock) {
    return set_lock(board_, command, *order);
  }
  auto store = open_store(board_);
  if (!store) {
    return std::move(store).error();
  }
  if (command.action == Action::Set) {
    return set(board_, command, *order, *store);
  }
  if (auto why = vars::refusal(vars::lock_of(board_), vars::Act::Force); why && !order->renew) {
    return Problem{std::move(*why)};
  }
  if (command.action == Action::Unforce) {
    return unforce(board_, command, *store);
  }
  std::erase_if(leases_, [&](const auto& one) { return one.second.until < store->now(); });
  const auto lease = leases_.find(command.commander);
  if (order->renew && lease == leases_.end()) {
    return Problem{"there is no such lease any more"};
  }
  const auto all = read_all(*store, order->renew ? lease->second.lines : order->lines);
  if (!all) {
    return all.error();
  }
  const rt::MonoTime until =
      order->for_ns > 0 ? store->now() + std::chrono::nanoseconds(order->for_ns) : rt::MonoTime(vars::kForever);
  if (order->renew) {
    const Status held = vars::prolong(*store, values_of(*all), lease->second.until, until);
    lease->second.until = until;
    return held ? Done() : Problem{"somebody else has let one of them go or forced it since"};
  }
  if (const Status forced = vars::hold(board_, *store, values_of(*all), until, note_about(command, *order)); !forced) {
    return Problem{forced.error().code == Errc::NoSpace
                       ? fmt::format("a node holds at most {} numbers", vars::kMostForces)
                       : fmt::format("these are not forced: {}", forced.error().where)};
  }
  for (const Wanted& one : *all) {
    note(board_, command, *order, "force", one.name, one.text);
  }
  if (order->lease) {
    leases_[command.commander] = {order->lines, until};
  }
  return {};
}

std::string locked_against_commands(const std::string& board) {
  return vars::refusal(vars::lock_of(board), vars::Act::Command).value_or("");
}

}  // namespace indurop::deploy
