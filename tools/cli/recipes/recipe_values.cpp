// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recipes/recipe_values.h"

#include <fmt/format.h>

#include <chrono>

#include "store/operate/set.h"
#include "store/vars/batch.h"
#include "tools/cli/values/assignment.h"
#include "tools/cli/values/forcing.h"
#include "tools/cli/values/node_choice.h"

namespace indurop::tools {
namespace {

std::string text_of(const base::Json& value) {
  return value.is_text() ? *value.text() : value.dump();
}

std::string what_failed(const Error& error) {
  switch (error.code) {
    case Errc::NotFound:
      return "the node was started by an older version: restart it";
    case Errc::InvalidArgument:
      return fmt::format("a tick changes at most {} values of {} KiB together: make two recipes of it",
                         vars::kMaxBatchValues, vars::kMaxBatchBytes >> 10U);
    case Errc::Timeout:
      return "the node does not tick";
    default:
      return fmt::format("{} ({}); try again", error.where, to_string(error.code));
  }
}

}  // namespace

int take_values(Context& context, const vars::Store& store, const std::vector<std::string>& names, Recipe& to) {
  std::vector<std::string> wanted = names;
  for (const schema::Variable& variable : store.schema().variables) {
    if (names.empty() && variable.given) {
      wanted.push_back(variable.name);
    }
  }
  if (wanted.empty()) {
    context.out.error("no variable of this node is a parameter (declared with a value): name what to save");
    return kFailed;
  }
  std::vector<Item> items;
  if (const int code = select_items(context, store, wanted, items); code != kOk) {
    return code;
  }
  for (const Item& item : items) {
    const auto bytes = operate::read(store, item);
    if (!bytes) {
      context.out.error(bytes.error().text);
      return kFailed;
    }
    to.values.emplace_back(item.name, raw_value(item.place.type, *bytes));
  }
  return kOk;
}

std::vector<Difference> compare(const vars::Store& store, const Recipe& recipe) {
  std::vector<Difference> all;
  for (const auto& [name, value] : recipe.values) {
    Difference one{name, value, {}, false};
    std::string message;
    const auto place = schema::find_place(store.schema(), name, message);
    const auto* entry = place.ok() ? store.find(place.value().variable->name_hash()) : nullptr;
    if (entry != nullptr) {
      if (const auto bytes = operate::read(store, {name, place.value(), entry})) {
        one.now = raw_value(place.value().type, *bytes);
        one.same = one.now.dump() == one.recipe.dump();
      }
    }
    all.push_back(std::move(one));
  }
  return all;
}

int load_values(Context& context, vars::Store& store, const Recipe& recipe, std::optional<std::uint64_t>& tick) {
  std::vector<std::string> words;
  for (const auto& [name, value] : recipe.values) {
    words.push_back(fmt::format("{}={}", name, text_of(value)));
  }
  const auto assignments = read_assignments(context, store, "recipe", words);
  if (!assignments) {
    return assignments.error().code;
  }
  if (!may_set(context, *assignments) || any_forced(context, store, *assignments)) {
    return kFailed;
  }
  tick.reset();
  if (!context.values->absence(&store).empty()) {
    return set_values(context, store, *assignments);
  }
  std::vector<vars::Change> changes;
  for (const Assignment& one : *assignments) {
    changes.push_back({one.item.entry, one.item.place.offset, one.bytes});
  }
  constexpr std::chrono::seconds kPatience{5};
  const auto done = vars::change_in_one_tick(context.node, store, changes, kPatience);
  if (!done) {
    context.out.error(fmt::format("nothing was changed: {}", what_failed(done.error())));
    return done.error().code == Errc::InvalidArgument ? kFailed : kUnreachable;
  }
  tick = *done;
  for (const Assignment& one : *assignments) {
    operate::note_set(context.node, store, one, who_orders(context));
  }
  return kOk;
}

}  // namespace indurop::tools
