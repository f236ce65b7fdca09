// SPDX-License-Identifier: Apache-2.0
// Words of alarm priorities, and alarm conditions.

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/schema/schema.h"

namespace indurop::schema {
namespace {

constexpr std::array<const char*, 4> kPriorities{"critical", "high", "medium", "low"};
static_assert(kPriorities.size() == static_cast<std::size_t>(Priority::Low) + 1);
constexpr std::array<const char*, 6> kSymbols{"==", "!=", "<", "<=", ">", ">="};
static_assert(kSymbols.size() == static_cast<std::size_t>(Comparison::GreaterEqual) + 1);

}  // namespace

const char* word_of(Priority priority) noexcept {
  return kPriorities.at(static_cast<std::size_t>(priority));
}

std::optional<Priority> priority_of(std::string_view word) noexcept {
  const auto* found = std::find(kPriorities.begin(), kPriorities.end(), word);
  return found == kPriorities.end() ? std::nullopt : std::optional(static_cast<Priority>(found - kPriorities.begin()));
}

const char* symbol_of(Comparison comparison) noexcept {
  return kSymbols.at(static_cast<std::size_t>(comparison));
}

std::string condition_text(const Type& type, const Alarm& alarm) {
  if (type.base == Base::Bool) {
    const bool wanted = (alarm.limit != 0) == (alarm.comparison == Comparison::Equal);
    return wanted ? "" : "== false";
  }
  for (const Enumerator& one : type.enumerators) {
    if (static_cast<double>(one.value) == alarm.limit) {
      return fmt::format("{} {}", symbol_of(alarm.comparison), one.name);
    }
  }
  return fmt::format("{} {}", symbol_of(alarm.comparison), alarm.limit);
}

bool is_met(const Alarm& alarm, double value, bool was_met) noexcept {
  const double back = was_met ? alarm.deadband : 0;
  switch (alarm.comparison) {
    case Comparison::Equal:
      return value == alarm.limit;
    case Comparison::NotEqual:
      return value != alarm.limit;
    case Comparison::Less:
      return value < alarm.limit + back;
    case Comparison::LessEqual:
      return value <= alarm.limit + back;
    case Comparison::Greater:
      return value > alarm.limit - back;
    case Comparison::GreaterEqual:
      return value >= alarm.limit - back;
  }
  return false;
}

}  // namespace indurop::schema
