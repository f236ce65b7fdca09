// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recipes/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/text.h"
#include "store/vars/retain.h"

namespace indurop::tools {
namespace {

constexpr std::int64_t kFormat = 1;

std::optional<Recipe> parse(std::string name, std::string_view text) {
  const auto json = base::Json::parse(text);
  std::int64_t format = 0;
  if (!json || !base::read(*json, "indurop_recipe", format) || format != kFormat || !(*json)["values"].is_object()) {
    return std::nullopt;
  }
  Recipe recipe;
  recipe.name = std::move(name);
  base::read(*json, "comment", recipe.comment);
  base::read(*json, "who", recipe.who);
  base::read(*json, "saved_wall_ns", recipe.saved_ns);
  const base::Json& values = (*json)["values"];
  std::size_t i = 0;
  for (const std::string& key : values.keys()) {
    recipe.values.emplace_back(key, values.values()[i++]);
  }
  return recipe;
}

std::filesystem::path file_of(const std::string& node, const std::string& name) {
  return recipe_folder(node) / (name + ".json");
}

}  // namespace

std::string wrong_recipe_name(std::string_view name) {
  constexpr std::size_t kLongest = 60;
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !name.empty() && name.size() <= kLongest && std::all_of(name.begin(), name.end(), good)
             ? std::string()
             : fmt::format("'{}' is no name of a recipe: 1 to {} letters, digits, '-' or '_'", name, kLongest);
}

std::filesystem::path recipe_folder(const std::string& node) {
  return vars::state_directory(node) / "recipes";
}

std::vector<Recipe> list_recipes(const std::string& node) {
  std::vector<Recipe> all;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(recipe_folder(node), none)) {
    if (entry.path().extension() != ".json" || !wrong_recipe_name(entry.path().stem().string()).empty()) {
      continue;
    }
    const auto text = base::read_file(entry.path());
    if (auto recipe = text ? parse(entry.path().stem().string(), *text) : std::nullopt) {
      all.push_back(std::move(*recipe));
    }
  }
  std::sort(all.begin(), all.end(), [](const Recipe& a, const Recipe& b) { return a.name < b.name; });
  return all;
}

Result<Recipe, base::Problem> read_recipe(const std::string& node, const std::string& name) {
  if (std::string wrong = wrong_recipe_name(name); !wrong.empty()) {
    return base::Problem{std::move(wrong)};
  }
  const auto text = base::read_file(file_of(node, name));
  if (!text) {
    std::vector<std::string> names;
    for (const Recipe& one : list_recipes(node)) {
      names.push_back(one.name);
    }
    return base::Problem{fmt::format("there is no recipe '{}'{}", name, base::suggestion(name, names))};
  }
  auto recipe = parse(name, *text);
  if (!recipe) {
    return base::Problem{fmt::format("{} is no recipe", file_of(node, name).string())};
  }
  return std::move(*recipe);
}

Result<void, base::Problem> write_recipe(const std::string& node, const Recipe& recipe) {
  if (std::string wrong = wrong_recipe_name(recipe.name); !wrong.empty()) {
    return base::Problem{std::move(wrong)};
  }
  base::Json values = base::Json::object();
  for (const auto& [name, value] : recipe.values) {
    values[name] = value;
  }
  base::Json json{{"indurop_recipe", kFormat},
                  {"comment", recipe.comment},
                  {"who", recipe.who},
                  {"saved_wall_ns", recipe.saved_ns}};
  json["values"] = std::move(values);
  std::error_code error;
  std::filesystem::create_directories(recipe_folder(node), error);
  const auto file = file_of(node, recipe.name);
  if (const auto saved = base::replace_file(file, json.dump(2) + "\n", base::Durable::Yes); !saved) {
    return base::Problem{base::cannot_write(file, saved.error())};
  }
  return {};
}

Result<void, base::Problem> remove_recipe(const std::string& node, const std::string& name) {
  if (const auto there = read_recipe(node, name); !there) {
    return there.error();
  }
  std::error_code error;
  std::filesystem::remove(file_of(node, name), error);
  return error ? Result<void, base::Problem>(base::Problem{error.message()}) : Result<void, base::Problem>();
}

base::Json summary_of(const Recipe& recipe) {
  return {{"recipe", recipe.name},
          {"comment", recipe.comment},
          {"who", recipe.who},
          {"saved_wall_ns", recipe.saved_ns},
          {"values", recipe.values.size()}};
}

}  // namespace indurop::tools
