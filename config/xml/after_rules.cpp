// SPDX-License-Identifier: Apache-2.0
#include "config/xml/after_rules.h"

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/text.h"

namespace indurop::config {
namespace {

using ByName = std::unordered_map<std::string, const Module*>;  // the first of equals

std::string no_module(const Config& config, const std::string& name, bool suggest) {
  std::vector<std::string> names;
  for (std::size_t i = 0; suggest && i < config.modules.size(); ++i) {
    names.push_back(config.modules[i].name);
  }
  return "no module is called " + base::in_quotes(name) + base::suggestion(name, names);
}

// Returns empty if `module` comes after the one of this name in the order of execution. `suggest`: a name that is not
// known is compared with all others.
std::string objection(const Config& config, const ByName& by_name, const Module& module, const std::string& name,
                      bool suggest) {
  const auto found = by_name.find(name);
  if (found == by_name.end()) {
    return no_module(config, name, suggest);
  }
  const Module* const earlier = found->second;
  if (earlier == &module) {
    return "a module does not come after itself; remove it";
  }
  if (earlier->operation != scheduler::Operation::Periodic) {
    return name + " is not periodic, so it has no place in the order; remove it";
  }
  const bool later = earlier->priority > module.priority || (earlier->priority == module.priority && earlier > &module);
  return later ? name + " has priority " + std::to_string(earlier->priority) + " and runs after " + module.name +
                     ", which has " + std::to_string(module.priority) + "; let it have a lower value"
               : "";
}

}  // namespace

void check_after(Config& config, base::Diagnostics& report) {
  ByName by_name;
  for (const Module& module : config.modules) {
    by_name.try_emplace(module.name, &module);
  }
  for (Module& module : config.modules) {
    std::vector<std::string> after;
    std::vector<base::SourcePlace> places;
    for (std::size_t i = 0; i < module.after.size(); ++i) {
      const std::string wrong = objection(config, by_name, module, module.after[i], !report.full());
      if (!wrong.empty()) {
        report.error(module.places.after[i], "<after>: " + wrong);
        continue;
      }
      after.push_back(std::move(module.after[i]));
      places.push_back(module.places.after[i]);
    }
    module.after = std::move(after);
    module.places.after = std::move(places);
  }
}

}  // namespace indurop::config
