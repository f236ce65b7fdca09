// SPDX-License-Identifier: Apache-2.0
// Facts from module.xml and plant.xml: who writes what, who waits for whom.

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "config/check/uses.h"
#include "config/xml/plant_reader.h"
#include "scheduler/words.h"
#include "tools/cli/explain/gather.h"
#include "tools/client/config/checked_config.h"

namespace indurop::tools {
namespace {

using explain::Facts;

// Adds the properties of one board's modules, unless they are known from a run.
void add_modules(const config::Config& config, const config::CheckResult& check, bool known, Facts& facts) {
  for (const config::Module& module : config.modules) {
    const auto found = std::find_if(facts.modules.begin(), facts.modules.end(),
                                    [&](const explain::ModuleFact& one) { return one.name == module.name; });
    if (found == facts.modules.end() || known) {
      continue;
    }
    found->operation = to_text(module.operation);
    found->type = to_text(module.type);
    found->period_ns = module.operation == scheduler::Operation::Periodic ? module.period.count() : 0;
    found->offset_ns = module.offset.count();
    found->deadline_ns = module.deadline.count();
    found->priority = module.priority;
    found->core = module.core;
  }
  for (const config::Sharing& sharing : check.sharing) {
    const std::string& first = config.modules[sharing.first].name;
    const std::string& second = config.modules[sharing.second].name;
    for (explain::ModuleFact& module : facts.modules) {
      if (module.name == second) {
        module.after.push_back(first);
      }
    }
  }
}

void add_plant(const std::string& file, const config::CheckOptions& options, bool known, Facts& facts) {
  const CheckedPlant checked = load_plant(file, options);
  facts.lease_ns = checked.plant.lease.count();
  const auto views = config::views_of(checked.plant, checked.check);
  const config::Uses uses(views);
  for (const auto& [name, users] : uses.variables()) {
    explain::VariableFact variable;
    variable.name = name;
    variable.writers = uses.names(users.writers);
    if (const auto owner = checked.check.owners.find(name); owner != checked.check.owners.end()) {
      variable.owner = checked.plant.boards[owner->second].name;
    }
    for (const config::Route& route : checked.check.routes) {
      variable.every_ns = route.variable == name ? route.every.count() : variable.every_ns;
    }
    facts.variables.push_back(std::move(variable));
  }
  for (const config::BoardView& view : views) {
    if (view.name == facts.board) {
      add_modules(view.config, view.result, known, facts);
    }
  }
}

}  // namespace

void add_config(const std::string& config, Facts& facts) {
  std::error_code error;
  if (config.empty() || !std::filesystem::exists(config, error)) {
    return;
  }
  const config::CheckOptions options{.files = true, .adjust = true};
  const bool known = std::any_of(facts.modules.begin(), facts.modules.end(),
                                 [](const explain::ModuleFact& one) { return !one.operation.empty(); });
  if (config::is_plant_file(config)) {
    add_plant(config, options, known, facts);
    return;
  }
  const CheckedConfig checked = load_config(config, options);
  for (const config::VariableUse& use : checked.check.uses) {
    facts.variables.push_back({use.name, use.writers, {}, 0, 0});
  }
  add_modules(checked.config, checked.check, known, facts);
}

}  // namespace indurop::tools
