// SPDX-License-Identifier: Apache-2.0
// Recipes and the values of a node: taken, compared, and loaded in one tick.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/recipes/recipe.h"
#include "tools/values/variables.h"

namespace indurop::tools {

// The values of variables, parts or globs; of none, all parameters: variables whose declaration has a value. The exit
// code, after an error message for each that is wrong.
int take_values(Context& context, const vars::Store& store, const std::vector<std::string>& names, Recipe& to);

struct Difference {
  std::string name;
  base::Json recipe;
  base::Json now;  // null: there is no such variable any more
  bool same = false;
};
// In the order of the recipe.
std::vector<Difference> compare(const vars::Store& store, const Recipe& recipe);

// All of them in one tick of the node `context.node`, or none: types, ranges and forces are looked at before, and every
// value that is wrong is an error message. Of a node that does not run they wait for its next start: `tick` is empty
// then. `store` is open to write. The exit code.
int load_values(Context& context, vars::Store& store, const Recipe& recipe, std::optional<std::uint64_t>& tick);

}  // namespace indurop::tools
