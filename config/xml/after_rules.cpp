// SPDX-License-Identifier: Apache-2.0
#include "config/xml/after_rules.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/text.h"

namespace indurop::config {
namespace {

// Returns empty if `module` comes after `earlier` in the order of execution.
std::string objection(const Config& config, const Module& module, const std::string& name) {
  const auto earlier = std::find_if(config.modules.begin(), config.modules.end(),
                                    [&](const Module& other) { return other.name == name; });
  if (earlier == config.modules.end()) {
    std::vector<std::string> names;
    for (const Module& other : config.modules) {
      names.push_back(other.name);
    }
    return "no module is called " + base::in_quotes(name) + base::suggestion(name, names);
  }
  if (&*earlier == &module) {
    return "a module does not come after itself; remove it";
  }
  if (earlier->operation != scheduler::Operation::Periodic) {
    return name + " is not periodic, so it has no place in the order; remove it";
  }
  const bool later =
      earlier->priority > module.priority || (earlier->priority == module.priority && &*earlier > &module);
  return later ? name + " has priority " + std::to_string(earlier->priority) + " and runs after " + module.name +
                     ", which has " + std::to_string(module.priority) + "; let it have a lower value"
               : "";
}

}  // namespace

void check_after(Config& config, base::Diagnostics& report) {
  for (Module& module : config.modules) {
    for (std::size_t i = 0; i < module.after.size();) {
      const std::string wrong = objection(config, module, module.after[i]);
      if (wrong.empty()) {
        ++i;
        continue;
      }
      report.error(module.places.after[i], "<after>: " + wrong);
      const auto at = static_cast<std::ptrdiff_t>(i);
      module.after.erase(module.after.begin() + at);
      module.places.after.erase(module.places.after.begin() + at);
    }
  }
}

}  // namespace indurop::config
