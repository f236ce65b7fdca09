// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/carry.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "node/modules/grown_array.h"

namespace indurop::node {
namespace {

using Item = ModuleMemory::Item;
using scheduler::Exchange;

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

void compare_items(const ModuleMemory& from, const ModuleMemory& to, Carry& carry) {
  std::map<std::string_view, const Item*> before;
  for (const Item& item : from.items()) {
    before.emplace(item.name, &item);
  }
  for (const Item& item : to.items()) {
    const auto found = before.find(item.name);
    if (found == before.end()) {
      list(item, carry.plan.added);
      continue;
    }
    const Item& old = *found->second;
    before.erase(found);
    const bool same = old.type == item.type && old.size == item.size && item.size > 0;
    if (!same && !(has_grown(old.type, item.type) && old.size < item.size)) {
      list(item, carry.plan.changed);
      continue;
    }
    list(item, same ? carry.plan.kept : carry.plan.grown);
    carry.plan.bytes += old.bytes();
    add_pair(old, item, carry.pairs);
  }
  for (const Item& item : from.items()) {
    if (before.contains(item.name)) {
      list(item, carry.plan.removed);
    }
  }
}

std::string why_fresh(const ModuleMemory& from, const ModuleMemory& to) {
  if (from.is_empty()) {
    return "";
  }
  if (!from.is_whole()) {
    return from.missing().empty() ? "the running version does not declare what it keeps (INDUROP_STATE)"
                                  : "the running version keeps what cannot be carried: " + from.missing();
  }
  if (!to.is_whole() && !to.is_empty()) {
    return to.missing().empty() ? "the new version does not declare what it keeps (INDUROP_STATE)"
                                : "the new version keeps what cannot be carried: " + to.missing();
  }
  return from.uses_functions() != to.uses_functions()
             ? "one version declares its variables, the other one copies them by functions (INDUROP_STATE_BY)"
             : "";
}

}  // namespace

std::size_t most_in_tick(std::int64_t period_ns) noexcept {
  constexpr std::int64_t kNsForOneByte = 20;  // of the period
  constexpr std::int64_t kNotPeriodicNs = 100'000;
  const std::int64_t bytes = (period_ns > 0 ? period_ns : kNotPeriodicNs) / kNsForOneByte;
  return std::min(static_cast<std::size_t>(bytes), kMostInTick);
}

Carry plan_carry(const ModuleMemory& from, const ModuleMemory& to, std::size_t most) {
  Carry carry;
  carry.plan.why_not = why_fresh(from, to);
  if (carry.plan.why_not.empty() && !from.is_empty()) {
    compare_items(from, to, carry);
    carry.plan.with_state = true;
    carry.between_runs = from.uses_functions() || from.has_addresses() || carry.plan.bytes > most;
  }
  if (from.uses_functions() || from.has_addresses()) {
    carry.plan.bytes = from.most();
  }
  if (carry.between_runs) {
    carry.pairs.clear();
  }
  carry.loses = !carry.plan.why_not.empty() || !carry.plan.changed.empty();
  return carry;
}

}  // namespace indurop::node
