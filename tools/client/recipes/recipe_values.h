// SPDX-License-Identifier: Apache-2.0
// Recipes and the values of a node: saved, compared, and loaded in one tick.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/json.h"
#include "store/operate/refusal.h"
#include "store/operate/who.h"
#include "store/vars/store.h"
#include "tools/client/recipes/recipe.h"

namespace indurop::tools {

// Adds the values of variables, parts or globs; if there are no names, of all parameters: variables whose declaration
// has a value. Returns what is wrong with each wrong name.
Result<void, std::vector<std::string>> take_values(const vars::Store& store, const std::vector<std::string>& names,
                                                   Recipe& to);

struct Difference {
  std::string name;
  base::Json recipe;
  base::Json now;  // null: the variable does not exist any more
  bool same = false;
};
// In the order of the recipe.
std::vector<Difference> compare(const vars::Store& store, const Recipe& recipe);

// Sets all values in one tick of the node, or none: types, ranges and forces are checked before. Returns the tick;
// nothing if the node does not run, then the values wait for its next start. `store` is open for writing.
Result<std::optional<std::uint64_t>, operate::Refusal> load_values(const std::string& node, vars::Store& store,
                                                                   const Recipe& recipe, const operate::Who& who);

}  // namespace indurop::tools
