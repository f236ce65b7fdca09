// SPDX-License-Identifier: Apache-2.0
// Answers about recipes: sets of parameters, compared with the current values, and loaded in one tick.
#include "core/rt/clock.h"
#include "tools/client/recipes/recipe_values.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/api/write.h"
#include "tools/serve/boards/local_board.h"

namespace indurop::serve::answers {
namespace {

std::string recipe_in(const Call& call) {
  return call.part.find("name")->second;
}

// The values to write, or the reply that says why not.
struct Body {
  std::vector<std::string> names;
  std::string comment;
  std::string reason;
};

std::vector<std::string> names_of(const tools::Recipe& recipe) {
  std::vector<std::string> names;
  std::transform(recipe.values.begin(), recipe.values.end(), std::back_inserter(names),
                 [](const auto& value) { return value.first; });
  return names;
}

std::optional<Body> read_body(const Call& call) {
  const auto json = base::Json::parse(call.request->body.empty() ? "{}" : call.request->body);
  if (!json || !json->is_object()) {
    return std::nullopt;
  }
  Body body;
  base::read(*json, "names", body.names);
  base::read(*json, "comment", body.comment);
  base::read(*json, "reason", body.reason);
  return body;
}

}  // namespace

Reply recipes(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  base::Json list = base::Json::array();
  for (const tools::Recipe& one : tools::list_recipes((*found)->name())) {
    list.push_back(tools::summary_of(one));
  }
  base::Json body = about(**found);
  body["recipes"] = std::move(list);
  return json_reply(body);
}

Reply recipe(Api& /*api*/, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const auto one = tools::read_recipe((*found)->name(), recipe_in(call));
  if (!one) {
    return refusal(status::kNotFound, one.error().text);
  }
  if ((*found)->store() == nullptr) {
    return refusal(status::kConflict, "the variables of this board cannot be read");
  }
  base::Json values = base::Json::array();
  for (const tools::Difference& value : tools::compare(*(*found)->store(), *one)) {
    values.push_back({{"name", value.name}, {"recipe", value.recipe}, {"now", value.now}, {"same", value.same}});
  }
  base::Json body = about(**found);
  body.update(tools::summary_of(*one));
  body["values"] = std::move(values);
  return json_reply(body);
}

Reply save_recipe(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "save recipe");
  const auto wanted = read_body(call);
  const std::string wrong = tools::wrong_recipe_name(recipe_in(call));
  if (!wanted || !wrong.empty()) {
    return write.failed(status::kBadRequest, wanted ? wrong : "the body is no JSON object");
  }
  write.about(recipe_in(call), wanted->reason);
  const auto store = open_to_write((*found)->name(), false);
  if (!store) {
    return write.failed(store.error());
  }
  tools::Recipe recipe{recipe_in(call), wanted->comment, call.who, rt::wall_ns(), {}};
  if (const auto taken = tools::take_values(*store, wanted->names, recipe); !taken) {
    return write.failed(Refused{status::kWrongValue, taken.error()});
  }
  if (const auto unlogged = write.begin({names_of(recipe)})) {
    return write.failed(*unlogged);
  }
  if (const auto saved = tools::write_recipe((*found)->name(), recipe); !saved) {
    return write.failed(status::kFailed, saved.error().text);
  }
  base::Json body = about(**found);
  body["recipe"] = recipe.name;
  body["values"] = recipe.values.size();
  return write.done(body);
}

Reply load_recipe(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "load recipe");
  const auto wanted = read_body(call);
  if (!wanted) {
    return write.failed(status::kBadRequest, "the body is no JSON object");
  }
  write.about(recipe_in(call), wanted->reason);
  const auto one = tools::read_recipe((*found)->name(), recipe_in(call));
  if (!one) {
    return write.failed(status::kNotFound, one.error().text);
  }
  auto store = open_to_write((*found)->name(), false);
  if (!store) {
    return write.failed(store.error());
  }
  if (const auto unlogged = write.begin({names_of(*one)})) {
    return write.failed(*unlogged);
  }
  const auto loaded = tools::load_values((*found)->name(), *store, *one, write.who());
  if (!loaded) {
    return write.failed(loaded.error());
  }
  base::Json body = about(**found);
  body["recipe"] = one->name;
  body["tick"] = *loaded ? base::Json(**loaded) : base::Json();
  body["values"] = one->values.size();
  return write.done(body);
}

Reply remove_recipe(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  Write write(api, call, "remove recipe");
  const auto wanted = read_body(call);
  write.about(recipe_in(call), wanted ? wanted->reason : std::string());
  const auto one = tools::read_recipe((*found)->name(), recipe_in(call));
  if (!one) {
    return write.failed(status::kNotFound, one.error().text);
  }
  if (const auto unlogged = write.begin({names_of(*one)})) {
    return write.failed(*unlogged);
  }
  if (const auto removed = tools::remove_recipe((*found)->name(), recipe_in(call)); !removed) {
    return write.failed(status::kFailed, removed.error().text);
  }
  base::Json body = about(**found);
  body["recipe"] = recipe_in(call);
  return write.done(body);
}

}  // namespace indurop::serve::answers
