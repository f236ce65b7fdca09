// SPDX-License-Identifier: Apache-2.0
#include "config/plan/plan_parts.h"

#include <numeric>

#include "scheduler/response_time.h"

namespace indurop::config {

std::vector<std::string> names_of(const Config& config, const CheckResult& check, const scheduler::Slot& slot) {
  std::vector<std::string> names;
  names.reserve(slot.items.size());
  for (const std::uint32_t item : slot.items) {
    names.push_back(config.modules[check.periodic[item]].name);
  }
  return names;
}

int core_of(const Config& config, const Module& module) {
  return module.core >= 0 ? module.core : config.core;
}

std::vector<std::size_t> waited_for(const Config& config, const CheckResult& check, std::size_t module) {
  std::vector<std::size_t> earlier;
  if (config.order == scheduler::CoreOrder::Data) {
    for (const Sharing& sharing : check.sharing) {
      if (sharing.second == module) {
        earlier.push_back(sharing.first);
      }
    }
    return earlier;
  }
  for (const std::size_t other : check.periodic) {
    if (config.modules[other].priority < config.modules[module].priority) {
      earlier.push_back(other);
    }
  }
  return earlier;
}

std::string in_order(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : " > ") + name;
  }
  return text;
}

base::Nanos slack_of(const Module& module, const Timing& timing) {
  const base::Nanos deadline = module.deadline > base::Nanos::zero() ? module.deadline : module.period;
  return timing.known && timing.worst != scheduler::WorstResponses::kNotDone ? deadline - timing.worst : base::Nanos{};
}

double utilisation(const Module& module) {
  const base::Nanos between = module.operation == scheduler::Operation::Sporadic ? module.deadline : module.period;
  return between > base::Nanos::zero() ? static_cast<double>(module.wcet.count()) / static_cast<double>(between.count())
                                       : 0.0;
}

double utilisation(const Config& config) {
  return std::accumulate(config.modules.begin(), config.modules.end(), 0.0,
                         [](double sum, const Module& module) { return sum + utilisation(module); });
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
