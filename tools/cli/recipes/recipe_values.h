// SPDX-License-Identifier: Apache-2.0
// Recipes and the values of a node: saved, compared, and loaded in one tick.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/cli/recipes/recipe.h"
#include "tools/cli/values/variables.h"

namespace indurop::tools {

// Adds the values of variables, parts or globs; if there are no names, of all parameters: variables whose declaration
// has a value. Returns the exit code, after an error message for each wrong name.
int take_values(Context& context, const vars::Store& store, const std::vector<std::string>& names, Recipe& to);

struct Difference {
  std::string name;
  base::Json recipe;
  base::Json now;  // null: the variable does not exist any more
  bool same = false;
};
// In the order of the recipe.
std::vector<Difference> compare(const vars::Store& store, const Recipe& recipe);

// Sets all values in one tick of the node `context.node`, or none: types, ranges and forces are checked before, with an
// error message for each wrong value. If the node does not run, the values wait for its next start and `tick` is empty.
// `store` is open for writing. Returns the exit code.
int load_values(Context& context, vars::Store& store, const Recipe& recipe, std::optional<std::uint64_t>& tick);

}  // namespace indurop::tools
