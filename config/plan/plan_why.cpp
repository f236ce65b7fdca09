// SPDX-License-Identifier: Apache-2.0
// Explains the plan: which core a module is on and why, and which modules wait for others on another core.

#include <fmt/format.h>

#include <algorithm>

#include "config/plan/plan_parts.h"
#include "core/base/text.h"

namespace indurop::config {
namespace {

std::string enumerate_cores(const std::vector<int>& cores) {
  std::vector<std::string> names;
  for (const int core : cores) {
    names.push_back(std::to_string(core));
  }
  return (cores.size() == 1 ? "core " : "cores ") + base::enumerate(names, kMaxSpreadCores);
}

std::string explain_spreading(const Config& config, const CheckResult& check, const Spreading& spreading) {
  std::string text = fmt::format(
      "Spread over {} (the first is the node's): busy for at most {} from the begin of a "
      "basic period of {}{}\n",
      enumerate_cores(spreading.cores), base::format_duration(spreading.busiest),
      base::format_duration(check.table.basic_period),
      spreading.holds ? "" : "; NOT ALL END IN TIME, no better placement was found");
  text += config.cores->split_sharing
              ? "Modules that share data may be on different cores and then wait for one another.\n"
              : "Modules that share data are on one core.\n";
  text += spreading.reordered
              ? "Modules that share nothing were reordered: with the given priorities the cores would finish later.\n"
              : "";
  std::size_t longest = 0;
  for (const Spreading::One& one : spreading.modules) {
    longest = std::max(longest, base::characters(config.modules[one.module].name));
  }
  for (const int core : spreading.cores) {
    base::Nanos work{};
    std::string lines;
    for (const Spreading::One& one : spreading.modules) {
      if (one.core != core) {
        continue;
      }
      const Module& module = config.modules[one.module];
      work += one.execution;
      lines +=
          fmt::format("  {}{}  {:>8}  {}{}\n", module.name, std::string(longest - base::characters(module.name), ' '),
                      base::format_duration(one.execution), one.why,
                      one.moved > base::Nanos::zero()
                          ? ", released " + base::format_duration(one.moved) + " later, else not all end in time"
                          : "");
    }
    text += fmt::format("Core {}: {}\n{}", core,
                        lines.empty() ? "nothing" : base::format_duration(work) + " if all run", lines);
  }
  return text;
}

// Explains waiting between modules on different cores.
std::string explain_waiting(const Config& config, const CheckResult& check) {
  std::string text;
  for (const Sharing& sharing : check.sharing) {
    const Module& second = config.modules[sharing.second];
    if (core_of(config, config.modules[sharing.first]) != core_of(config, second) &&
        second.operation == scheduler::Operation::Periodic) {
      text += fmt::format("  {} waits for {}: {}\n", second.name, config.modules[sharing.first].name, sharing.why);
    }
  }
  return text.empty() ? "No module waits for one of another core.\n" : "Between cores, within a basic period:\n" + text;
}

}  // namespace

std::string plan_why(const Config& config, const CheckResult& check) {
  if (!uses_several_cores(config)) {
    return "\nAll modules are on one core: the one of lower priority runs later. <cores>auto</cores> spreads them.\n";
  }
  if (config.order == scheduler::CoreOrder::Total) {
    return "\nA module waits for all of higher priority, on whatever core, because of <order>total</order>.\n";
  }
  return "\n" + (check.spreading ? explain_spreading(config, check, *check.spreading) : std::string()) +
         explain_waiting(config, check);
}

std::string plan_why(const Plant& plant, const PlantCheck& check) {
  std::string text;
  for (std::size_t i = 0; i < plant.boards.size(); ++i) {
    text += "\nBoard " + plant.boards[i].name + plan_why(plant.boards[i].config, check.boards[i]);
  }
  return text;
}

}  // namespace indurop::config
