// SPDX-License-Identifier: Apache-2.0
// Named sets of parameters, as JSON files in the state folder of a node that users may read, copy and keep.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/json.h"
#include "core/base/problem.h"

namespace indurop::tools {

struct Recipe {
  std::string name;
  std::string comment;
  std::string who;
  std::int64_t saved_ns = 0;  // CLOCK_REALTIME
  std::vector<std::pair<std::string, base::Json>> values;
};

// Returns what is wrong with a name, else an empty text. A name has letters, digits, '-', '_'; it becomes a file name.
std::string wrong_recipe_name(std::string_view name);
std::filesystem::path recipe_folder(const std::string& node);

// Returns them sorted by name, without files that are not recipes.
std::vector<Recipe> list_recipes(const std::string& node);
Result<Recipe, base::Problem> read_recipe(const std::string& node, const std::string& name);
// Atomically replaces an older one of that name.
Result<void, base::Problem> write_recipe(const std::string& node, const Recipe& recipe);
Result<void, base::Problem> remove_recipe(const std::string& node, const std::string& name);

// The recipe without its values, for lists.
base::Json summary_of(const Recipe& recipe);

}  // namespace indurop::tools
