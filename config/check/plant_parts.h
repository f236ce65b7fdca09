// SPDX-License-Identifier: Apache-2.0
// The parts of check_plant() that look at all boards together.

#pragma once

#include <span>
#include <vector>

#include "base/diagnostics.h"
#include "config/check/check_plant.h"
#include "config/check/uses.h"

namespace indurop::config {

struct PlantContext {
  Plant& plant;
  std::span<const BoardView> boards;
  const Uses& uses;
  const schema::Schema& schema;  // of all boards
  base::Diagnostics& report;
};

// The rule for a variable of this full name; nullptr: none.
const VariableRule* rule_for(const Plant& plant, const std::string& variable);

// Which board owns each variable that has a writer, and which boards need it.
std::vector<Route> find_routes(PlantContext& context, PlantCheck& result);
// Are the boards' keys there, and theirs; of an open plant that it is open.
void check_security(const Plant& plant, const CheckOptions& options, base::Diagnostics& report);
// How old values are that come from other boards. Fills Route::oldest.
void check_ages(PlantContext& context, std::vector<Route>& routes);

}  // namespace indurop::config
