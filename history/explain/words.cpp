// SPDX-License-Identifier: Apache-2.0
#include "history/explain/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "history/explain/answer.h"

namespace indurop::explain {

const char* to_text(Cause cause) noexcept {
  static constexpr std::array<const char*, 17> kWords{
      "not-known", "all-is-well", "not-due",   "own-time", "fault", "stopped", "machine", "schedule", "board",
      "network",   "rate",        "unchanged", "nobody",   "force", "set",     "module",  "device"};
  const auto number = static_cast<std::size_t>(cause);
  return number < kWords.size() ? kWords.at(number) : "not-known";
}

const ModuleFact* Facts::find_module(std::string_view name) const noexcept {
  const auto found = std::find_if(modules.begin(), modules.end(), [&](const auto& one) { return one.name == name; });
  return found == modules.end() ? nullptr : &*found;
}

const VariableFact* Facts::find_variable(std::string_view name) const noexcept {
  const auto found =
      std::find_if(variables.begin(), variables.end(), [&](const auto& one) { return one.name == name; });
  return found == variables.end() ? nullptr : &*found;
}

const BoardFact* Facts::find_peer(std::string_view name) const noexcept {
  const auto found = std::find_if(boards.begin(), boards.end(), [&](const auto& one) { return one.name == name; });
  return found == boards.end() ? nullptr : &*found;
}

const HoleFact* Facts::hole_around(std::uint32_t module, std::uint64_t number) const noexcept {
  const auto found = std::find_if(holes.begin(), holes.end(), [&](const HoleFact& one) {
    return one.module == module && one.after_tick < number && number < one.before_tick;
  });
  return found == holes.end() ? nullptr : &*found;
}

const HoleFact* Facts::hole_within(std::int32_t core, std::int64_t from_ns, std::int64_t to_ns) const noexcept {
  const auto found = std::find_if(holes.begin(), holes.end(), [&](const HoleFact& one) {
    return modules[one.module].core == core && one.from_ns < to_ns && one.to_ns > from_ns;
  });
  return found == holes.end() ? nullptr : &*found;
}

std::uint64_t Facts::tick_at(std::int64_t time_ns) const noexcept {
  return time_ns <= epoch_ns || basic_period_ns <= 0
             ? 0
             : static_cast<std::uint64_t>((time_ns - epoch_ns) / basic_period_ns);
}

std::string short_time(std::int64_t ns) {
  static constexpr std::array<std::pair<double, const char*>, 4> kUnits{
      {{1e9, "s"}, {1e6, "ms"}, {1e3, "us"}, {1, "ns"}}};
  const auto value = static_cast<double>(ns);
  for (const auto& [size, unit] : kUnits) {
    if (std::abs(value) >= size) {
      return fmt::format("{:.3g} {}", value / size, unit);
    }
  }
  return "0 ns";
}

std::string at_tick(const Facts& facts, std::uint64_t tick) {
  return fmt::format("tick {} ({})", tick, short_time(static_cast<std::int64_t>(tick) * facts.basic_period_ns));
}

std::string when(const Facts& facts, std::int64_t time_ns) {
  return time_ns < facts.epoch_ns ? "before tick 0" : at_tick(facts, facts.tick_at(time_ns));
}

std::string quality_text(std::int64_t number) {
  static constexpr std::array<const char*, 6> kTexts{"nothing has been exchanged yet",
                                                     "its data is good",
                                                     "it is lost: no connection, no answer in time, or an invalid one",
                                                     "it reports that it does not have this point",
                                                     "a value did not fit and was limited",
                                                     "nothing is sent any more because the tick has stopped"};
  const bool known = number >= 0 && number < static_cast<std::int64_t>(kTexts.size());
  return known ? kTexts.at(static_cast<std::size_t>(number)) : "its data is not good";
}

std::string who(const OrderFact& order) {
  const std::string user = order.who.empty() ? "unknown user" : order.who;
  return order.from.empty() ? user : fmt::format("{} on {}", user, order.from);
}

}  // namespace indurop::explain
