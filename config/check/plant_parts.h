// SPDX-License-Identifier: Apache-2.0
// The parts of check_plant() that check all boards together.

#pragma once

#include <span>
#include <vector>

#include "config/check/check_plant.h"
#include "config/check/uses.h"
#include "core/base/diagnostics.h"

namespace indurop::config {

struct PlantContext {
  Plant& plant;
  std::span<const BoardView> boards;
  const Uses& uses;
  const schema::Schema& schema;  // of all boards
  base::Diagnostics& report;
};

// Returns the rule for the variable with this full name; nullptr: none.
const VariableRule* rule_for(const Plant& plant, const std::string& variable);

// Determines the owner of each variable that has a writer, and the boards that need it.
std::vector<Route> find_routes(PlantContext& context, PlantCheck& result);
// Checks the pools that are sent between boards, and replaces their names by full names.
void check_pools(PlantContext& context);
// Checks that the keys of the boards and of the plant exist; reports if the plant is open.
void check_security(const Plant& plant, const CheckOptions& options, base::Diagnostics& report);
// Determines the age of values that come from other boards. Fills Route::oldest.
void check_ages(PlantContext& context, std::vector<Route>& routes);

}  // namespace indurop::config
