// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/guard_condition.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "core/base/text.h"
#include "core/schema/leaf.h"

namespace indurop::node {
namespace {

// Longer symbols first.
constexpr std::array kComparisons{schema::Comparison::Equal,     schema::Comparison::NotEqual,
                                  schema::Comparison::LessEqual, schema::Comparison::GreaterEqual,
                                  schema::Comparison::Less,      schema::Comparison::Greater};

base::Problem wrong(std::string_view text, const std::string& why) {
  return {fmt::format("--guard \"{}\": {}; write a number, a comparison (== != < <= > >=) and a value: \"O0 == 0\"",
                      text, why)};
}

}  // namespace

Result<GuardCondition, base::Problem> GuardCondition::parse(std::string_view text, const vars::Store& store) {
  for (const schema::Comparison comparison : kComparisons) {
    const std::string_view symbol = schema::symbol_of(comparison);
    const std::size_t at = text.find(symbol);
    if (at == std::string_view::npos) {
      continue;
    }
    const auto place = schema::find_place(store.schema(), base::trimmed(text.substr(0, at)));
    if (!place) {
      return wrong(text, place.error().message);
    }
    GuardCondition guard;
    guard.text_ = text;
    guard.type_ = place->type;
    guard.offset_ = place->offset;
    const vars::DirectoryEntry* const entry = store.find(place->variable->name_hash());
    guard.entry_ = entry != nullptr ? *entry : vars::DirectoryEntry{};
    guard.condition_.comparison = comparison;
    std::vector<std::uint8_t> limit(guard.type_.size());
    const auto parsed = schema::parse_value(guard.type_, base::trimmed(text.substr(at + symbol.size())), limit);
    if (!parsed) {
      return wrong(text, parsed.error().message);
    }
    const auto number = schema::as_number<double>(guard.type_.base, limit.data());
    if (!number || !guard.type_.dims.empty() || entry == nullptr) {
      return wrong(text, "this is no single number");
    }
    guard.condition_.limit = *number;
    return guard;
  }
  return wrong(text, "there is no comparison");
}

bool GuardCondition::holds(const vars::Store& store) const {
  std::vector<std::uint8_t> now(type_.size());
  if (!store.read(entry_, offset_, now).ok()) {
    return false;
  }
  const auto number = schema::as_number<double>(type_.base, now.data());
  return number && schema::is_met(condition_, *number, false);
}

}  // namespace indurop::node
