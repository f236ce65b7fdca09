// SPDX-License-Identifier: Apache-2.0
#include "config/plan/plan_parts.h"

namespace indurop::config {

std::vector<std::string> names_of(const Config& config, const CheckResult& check, const scheduler::Slot& slot) {
  std::vector<std::string> names;
  names.reserve(slot.items.size());
  for (const std::uint32_t item : slot.items) {
    names.push_back(config.modules[check.periodic[item]].name);
  }
  return names;
}

std::string in_order(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : " > ") + name;
  }
  return text;
}

std::string milliseconds(base::Nanos value) {
  constexpr std::int64_t kMilli = 1'000'000;
  std::string text = std::to_string(value.count() / kMilli);
  std::string decimals = std::to_string(value.count() % kMilli);
  decimals.insert(0, 6 - decimals.size(), '0');
  decimals.erase(decimals.find_last_not_of('0') + 1);
  return decimals.empty() ? text : text + "." + decimals;
}

}  // namespace indurop::config
