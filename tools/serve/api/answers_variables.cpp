// SPDX-License-Identifier: Apache-2.0
// Answers about variables and their values.
#include <fmt/format.h>

#include "core/base/hexadecimal.h"
#include "tools/client/history/tape_history.h"
#include "tools/serve/api/answers.h"
#include "tools/serve/boards/board.h"
#include "tools/serve/boards/variable.h"

namespace indurop::serve::answers {
namespace {

base::Json modules_of(const tools::KnownUses& uses, const std::string& variable,
                      std::vector<std::string> config::VariableUse::*which) {
  if (uses.empty()) {
    return {};
  }
  const auto found = uses.find(variable);
  return found != uses.end() ? base::Json(found->second.*which) : base::Json::array();
}

base::Json variable_json(const vars::Store& store, const tools::Item& item, const tools::KnownUses& uses,
                         const std::vector<vars::Force>& forces, bool values, bool as_bytes = false) {
  const schema::Variable& variable = *item.place.variable;
  base::Json out = base::Json::object();
  out["name"] = item.name;
  out["type"] = schema::display_name(item.place.type);
  out["form"] = form_of(item.place.type);
  Quality quality = quality_of(store, item);
  if (values) {
    auto bytes = operate::read(store, item);
    if (bytes) {
      operate::overlay(forces, item, *bytes);
    }
    quality = bytes ? quality : Quality::Unread;
    out["value"] = bytes ? tools::raw_value(item.place.type, *bytes) : base::Json();
    out["text"] = bytes ? schema::format_value(item.place.type, *bytes) : std::string();
    if (bytes && as_bytes) {
      out["bytes"] = base::in_hexadecimal(*bytes);
    }
  }
  out["unit"] = item.place.unit;
  out["range"] = range_of(item.place.range);
  out["retain"] = variable.retain;
  out["writers"] = modules_of(uses, variable.name, &config::VariableUse::writers);
  out["readers"] = modules_of(uses, variable.name, &config::VariableUse::readers);
  out["description"] = variable.description;
  out["source"] = variable.source;
  const auto age = age_of(store, item);
  out["age_ns"] = age ? base::Json(*age) : base::Json();
  out["quality"] = word_of(quality);
  base::Json forced = base::Json::array();
  for (const vars::Force& force : forces) {
    if (operate::touches(force, item)) {
      forced.push_back(schema::part_at(variable, force.offset).name);
    }
  }
  out["forced"] = std::move(forced);
  return out;
}

Reply no_store(const Board& board) {
  return refusal(status::kConflict, board.no_store());
}

}  // namespace

Reply variables(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const Board& board = **found;
  if (board.store() == nullptr) {
    return no_store(board);
  }
  const std::string values = query_value(*call.request, "values").value_or("true");
  if (values != "true" && values != "false") {
    return refusal(status::kBadRequest, "values is true or false");
  }
  const auto match = query_value(*call.request, "match");
  std::vector<std::string> problems;
  const auto items = items_named(*board.store(), board.name(), {match.value_or("*")}, problems);
  const tools::KnownUses& uses = api.uses_of(board);
  const auto forces = board.store()->forces();
  const auto held = board.remote() == nullptr ? tools::TapeHistory::held(board.name(), *board.store())
                                              : std::vector<bool>(board.store()->directory().size());
  base::Json list = base::Json::array();
  for (const tools::Item& item : items) {
    base::Json one = variable_json(*board.store(), item, uses, forces, values == "true");
    one["taped"] = bool{held[static_cast<std::size_t>(item.entry - board.store()->directory().data())]};
    list.push_back(std::move(one));
  }
  base::Json body = about(board);
  body["layout"] = board.layout();
  body["alive"] = board.alive();
  body["uses_known"] = !uses.empty();
  body["variables"] = std::move(list);
  return json_reply(body);
}

Reply variable(Api& api, const Call& call) {
  const auto found = board_of(call);
  if (!found) {
    return found.error();
  }
  const Board& board = **found;
  if (board.store() == nullptr) {
    return no_store(board);
  }
  const std::string form = query_value(*call.request, "values").value_or("json");
  if (form != "json" && form != "bytes") {
    return refusal(status::kBadRequest, "values is json or bytes");
  }
  const std::string& name = call.part.find("name")->second;
  std::vector<std::string> problems;
  const auto items =
      tools::is_glob(name) ? std::vector<tools::Item>() : items_named(*board.store(), board.name(), {name}, problems);
  if (items.empty()) {
    return refusal(status::kNotFound,
                   problems.empty() ? fmt::format("'{}' is no name of a variable", name) : problems.front());
  }
  return json_reply(
      variable_json(*board.store(), items.front(), api.uses_of(board), board.store()->forces(), true, form == "bytes"));
}

}  // namespace indurop::serve::answers
