// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/carry.h"

#include <algorithm>
#include <map>
#include <span>
#include <string_view>

#include "store/tape/grown_array.h"
#include "store/tape/state_form.h"

namespace indurop::node {
namespace {

using Item = ModuleMemory::Item;
using scheduler::Exchange;

// What a version declares that it keeps.
struct Declared {
  std::span<const Item> items;
  bool is_whole = false;
  bool is_empty = false;
  bool uses_functions = false;
  std::string missing;
};

Declared declared_by(const ModuleMemory& memory) {
  return {memory.items(), memory.is_whole(), memory.is_empty(), memory.uses_functions(), memory.missing()};
}

// `items`: what is declared, without addresses. A form that is not there is that of a process which declares nothing,
// or something that no keyframe can have.
Declared declared_by(const std::optional<std::string>& form, std::vector<Item>& items) {
  Declared declared;
  declared.is_empty = form && form->empty();
  declared.is_whole = form && !form->empty();
  std::string_view rest = form ? std::string_view(*form) : std::string_view();
  while (const auto line = tape::take_line(rest)) {
    if (line->type == tape::kFormOfFunctions) {
      declared.uses_functions = true;
    } else {
      items.push_back(
          {std::string(line->name), std::string(line->type), nullptr, line->size, ModuleMemory::kind_of(line->type)});
    }
  }
  declared.items = items;
  return declared;
}

void add_pair(const Item& from, const Item& to, std::vector<Exchange::Pair>& pairs) {
  const Exchange::Pair pair{static_cast<std::byte*>(from.address), static_cast<std::byte*>(to.address), from.size};
  if (!pairs.empty() && pairs.back().old_place + pairs.back().bytes == pair.old_place &&
      pairs.back().new_place + pairs.back().bytes == pair.new_place) {
    pairs.back().bytes += pair.bytes;
  } else {
    pairs.push_back(pair);
  }
}

void list(const Item& item, std::vector<std::string>& names) {
  if (item.kind != ModuleMemory::Kind::Shown) {
    names.push_back(item.name);
  }
}

void compare_items(std::span<const Item> from, std::span<const Item> to, Carry& carry) {
  std::map<std::string_view, const Item*> before;
  for (const Item& item : from) {
    before.emplace(item.name, &item);
  }
  for (const Item& item : to) {
    const auto found = before.find(item.name);
    if (found == before.end()) {
      list(item, carry.plan.added);
      continue;
    }
    const Item& old = *found->second;
    before.erase(found);
    const bool same = old.type == item.type && old.size == item.size && item.size > 0;
    if (!same && !(tape::has_grown(old.type, item.type) && old.size < item.size)) {
      list(item, carry.plan.changed);
      continue;
    }
    list(item, same ? carry.plan.kept : carry.plan.grown);
    carry.plan.bytes += old.bytes();
    add_pair(old, item, carry.pairs);
  }
  for (const Item& item : from) {
    if (before.contains(item.name)) {
      list(item, carry.plan.removed);
    }
  }
}

std::string why_fresh(const Declared& from, const Declared& to) {
  if (from.is_empty) {
    return "";
  }
  if (!from.is_whole) {
    return from.missing.empty() ? "the running version does not declare what it keeps (INDUROP_STATE)"
                                : "the running version keeps what cannot be carried: " + from.missing;
  }
  if (!to.is_whole && !to.is_empty) {
    return to.missing.empty() ? "the new version does not declare what it keeps (INDUROP_STATE)"
                              : "the new version keeps what cannot be carried: " + to.missing;
  }
  return from.uses_functions != to.uses_functions
             ? "one version declares its variables, the other one copies them by functions (INDUROP_STATE_BY)"
             : "";
}

Carry compare(const Declared& from, const Declared& to) {
  Carry carry;
  carry.plan.why_not = why_fresh(from, to);
  if (carry.plan.why_not.empty() && !from.is_empty) {
    compare_items(from.items, to.items, carry);
    carry.plan.with_state = true;
  }
  carry.loses = !carry.plan.why_not.empty() || !carry.plan.changed.empty();
  return carry;
}

}  // namespace

std::size_t most_in_tick(std::int64_t period_ns) noexcept {
  constexpr std::int64_t kNsForOneByte = 20;  // of the period
  constexpr std::int64_t kNotPeriodicNs = 100'000;
  const std::int64_t bytes = (period_ns > 0 ? period_ns : kNotPeriodicNs) / kNsForOneByte;
  return std::min(static_cast<std::size_t>(bytes), kMostInTick);
}

Carry plan_carry(const ModuleMemory& from, const ModuleMemory& to, std::size_t most) {
  Carry carry = compare(declared_by(from), declared_by(to));
  const bool is_whole_copy = from.uses_functions() || from.has_addresses();
  if (is_whole_copy) {
    carry.plan.bytes = from.most();
  }
  if (carry.plan.with_state && (is_whole_copy || carry.plan.bytes > most)) {
    carry.carry_between_runs();
  }
  return carry;
}

Carry plan_carry(const std::optional<std::string>& from, const std::optional<std::string>& to) {
  std::vector<Item> before;
  std::vector<Item> after;
  const Declared running = declared_by(from, before);
  Carry carry = compare(running, declared_by(to, after));
  carry.pairs.clear();
  return carry;
}

}  // namespace indurop::node
