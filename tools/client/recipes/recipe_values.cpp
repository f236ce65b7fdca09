// SPDX-License-Identifier: Apache-2.0
#include "tools/client/recipes/recipe_values.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "control/plc/st/value_literal.h"
#include "core/schema/place_index.h"
#include "store/operate/item.h"
#include "store/operate/set.h"
#include "store/vars/batch.h"
#include "tools/client/values/here_source.h"

namespace indurop::tools {
namespace {

std::string text_of(const base::Json& value) {
  return value.is_text() ? *value.text() : value.dump();
}

base::Json json_of(const schema::Type& type, const std::vector<std::uint8_t>& bytes) {
  return base::Json::parse(schema::value_to_json(type, bytes)).value_or(base::Json());
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

Result<void, std::vector<std::string>> take_values(const vars::Store& store, const std::vector<std::string>& names,
                                                   Recipe& to) {
  std::vector<std::string> wanted = names;
  for (const schema::Variable& variable : store.schema().variables) {
    if (names.empty() && variable.is_parameter()) {
      wanted.push_back(variable.name);
    }
  }
  if (wanted.empty()) {
    return std::vector<std::string>{
        "no variable of this node is a parameter (declared with a value and not @optional): name what to save"};
  }
  const auto items = operate::select(store, wanted);
  if (!items) {
    return items.error();
  }
  for (const operate::Item& item : *items) {
    const auto bytes = operate::read(store, item);
    if (!bytes) {
      return std::vector<std::string>{bytes.error().text};
    }
    to.values.emplace_back(item.name, json_of(item.place.type, *bytes));
  }
  return {};
}

std::vector<Difference> compare(const vars::Store& store, const Recipe& recipe) {
  const schema::PlaceIndex index(store.schema());
  std::vector<Difference> all;
  for (const auto& [name, value] : recipe.values) {
    Difference one{name, value, {}, false};
    const auto place = index.find(name, schema::NearestName::Skip);
    const auto* entry = place.ok() ? store.find(place.value().variable->name_hash()) : nullptr;
    if (entry != nullptr) {
      if (const auto bytes = operate::read(store, {name, place.value(), entry})) {
        one.now = json_of(place.value().type, *bytes);
        one.same = one.now.dump() == one.recipe.dump();
      }
    }
    all.push_back(std::move(one));
  }
  return all;
}

Result<std::optional<std::uint64_t>, operate::Refusal> load_values(const std::string& node, vars::Store& store,
                                                                   const Recipe& recipe, const operate::Who& who) {
  using operate::Why;
  std::vector<std::string> lines;
  for (const auto& [name, value] : recipe.values) {
    lines.push_back(fmt::format("{}={}", name, text_of(value)));
  }
  auto assignments = operate::parse_all(store, lines, &plc::read_value_literal);
  if (!assignments) {
    return operate::Refusal{Why::Wrong, std::move(assignments).error()};
  }
  if (auto locked = operate::refusal_to_set(node, *assignments)) {
    return std::move(*locked);
  }
  if (auto forced = operate::forced(store, *assignments)) {
    return std::move(*forced);
  }
  if (!HereSource(node, vars::Mode::ReadWrite).absence(&store).empty()) {
    if (auto done = operate::set(node, store, *assignments, who); !done) {
      return std::move(done).error();
    }
    return std::optional<std::uint64_t>();
  }
  std::vector<vars::Change> changes;
  for (const operate::Assignment& one : *assignments) {
    changes.push_back({one.item.entry, one.item.place.offset, one.bytes});
  }
  constexpr std::chrono::seconds kPatience{5};
  const auto done = vars::change_in_one_tick(node, store, changes, kPatience);
  if (!done) {
    return operate::Refusal{done.error().code == Errc::InvalidArgument ? Why::Wrong : Why::Busy,
                            {fmt::format("nothing was changed: {}", what_failed(done.error()))}};
  }
  for (const operate::Assignment& one : *assignments) {
    operate::note_set(node, store, one, who);
  }
  return std::optional<std::uint64_t>(*done);
}

}  // namespace indurop::tools
