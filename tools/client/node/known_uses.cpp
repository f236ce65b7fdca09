// SPDX-License-Identifier: Apache-2.0
#include "tools/client/node/known_uses.h"

#include <vector>

#include "config/check/uses.h"
#include "config/xml/plant_reader.h"
#include "tools/client/config/checked_config.h"
#include "tools/client/node/run_view.h"

namespace indurop::tools {
namespace {

// Returns the modules of all boards as "control@sensor".
std::vector<config::VariableUse> uses_in(const CheckedPlant& checked) {
  const auto boards = config::views_of(checked.plant, checked.check);
  const config::Uses uses(boards);
  std::vector<config::VariableUse> all;
  for (const auto& [name, users] : uses.variables()) {
    all.push_back({name, uses.names(users.readers), uses.names(users.writers)});
  }
  return all;
}

}  // namespace

KnownUses known_uses(const std::string& node) {
  KnownUses uses;
  const auto run = RunView::open(node);
  if (!run.ok()) {
    return uses;
  }
  const std::string file = fixed_text(run.value().block().config_file);
  const config::CheckOptions options{.files = true, .adjust = true};
  for (const config::VariableUse& use :
       config::is_plant_file(file) ? uses_in(load_plant(file, options)) : load_config(file, options).check.uses) {
    uses.emplace(use.name, use);
  }
  return uses;
}

}  // namespace indurop::tools
