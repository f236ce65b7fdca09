// SPDX-License-Identifier: Apache-2.0
// Sets of parameters under a name, as files of JSON in the state folder of a node: people may read, copy and keep them.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.h"
#include "base/problem.h"

namespace indurop::tools {

struct Recipe {
  std::string name;
  std::string comment;
  std::string who;
  std::int64_t saved_ns = 0;  // CLOCK_REALTIME
  std::vector<std::pair<std::string, base::Json>> values;
};

// What is wrong with a name, else nothing: letters, digits, '-', '_'; it becomes the name of a file.
std::string wrong_recipe_name(std::string_view name);
std::filesystem::path recipe_folder(const std::string& node);

// By name. What is no recipe is left out.
std::vector<Recipe> list_recipes(const std::string& node);
Result<Recipe, base::Problem> read_recipe(const std::string& node, const std::string& name);
// Replaces an older one of that name, in one step.
Result<void, base::Problem> write_recipe(const std::string& node, const Recipe& recipe);
Result<void, base::Problem> remove_recipe(const std::string& node, const std::string& name);

// Without its values, for lists.
base::Json summary_of(const Recipe& recipe);

}  // namespace indurop::tools
