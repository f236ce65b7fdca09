// SPDX-License-Identifier: Apache-2.0
#include "tools/client/values/variables.h"

#include <fmt/format.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "tools/client/node/node_choice.h"
#include "tools/client/text/units.h"
#include "tools/client/values/value_source.h"

namespace indurop::tools {
namespace {

void add_item(Item item, std::vector<Item>& items) {
  const bool known = std::any_of(items.begin(), items.end(), [&](const Item& one) {
    return one.entry == item.entry && one.place.offset == item.place.offset && one.name == item.name;
  });
  if (!known) {
    items.push_back(std::move(item));
  }
}

// Returns the exit code, after an error message: there is no such variable, or its board cannot be reached.
int unknown(Access& access, const std::string& name, const std::string& message) {
  if (const std::string owner = access.values->silent_owner(name); !owner.empty()) {
    access.messages->error(fmt::format("'{}' is of board {}, which is silent", name, owner));
    return kUnreachable;
  }
  access.messages->error(message);
  const std::string silent = access.values->here() ? std::string() : access.values->absence(nullptr);
  if (silent.empty()) {
    return kFailed;
  }
  access.messages->note("it may be of a board that is " + silent);
  return kUnreachable;
}

// Splits "NAME@BOARD". Returns the exit code, after an error message.
int take_board(Access& access, const vars::Store& store, std::string& name, std::string& board) {
  const auto at = name.rfind('@');
  if (access.values->here() || at == std::string::npos) {
    return kOk;
  }
  board = name.substr(at + 1);
  name.resize(at);
  std::string pattern = name;
  if (!is_glob(name)) {
    const auto place = schema::find_place(store.schema(), name);
    pattern = place.ok() ? place.value().variable->name : name;
  }
  const std::string problem = access.values->prefer(pattern, board);
  return problem.empty() ? kOk : unknown(access, name, problem);
}

// Removes the items that the keys do not permit reading. Returns false if these were all.
bool drop_forbidden(Access& access, std::vector<Item>& items) {
  std::set<std::string> forbidden;
  std::erase_if(items, [&](const Item& item) {
    const std::string& variable = item.place.variable->name;
    return access.values->forbidden(variable) && (forbidden.insert(variable), true);
  });
  if (forbidden.empty()) {
    return true;
  }
  const std::string text =
      fmt::format("the keys given by --keys do not let {} be read (indurop keys list -o json shows their lists)",
                  fmt::join(forbidden, ", "));
  if (items.empty()) {
    access.messages->error(text);
  } else {
    access.messages->note(text);
  }
  return !items.empty();
}

}  // namespace

int select_items(Access& access, const vars::Store& store, const std::vector<std::string>& names,
                 std::vector<Item>& items, Values values) {
  int code = kOk;
  for (std::string name : names) {
    std::string board;
    if (const int refused = take_board(access, store, name, board); refused != kOk) {
      code = refused;
      continue;
    }
    if (!is_glob(name)) {
      auto found = operate::find(store, name);
      if (found) {
        add_item(std::move(found).value(), items);
      } else {
        code = unknown(access, name, found.error().text);
      }
      continue;
    }
    bool any = false;
    for (const auto& variable : store.schema().variables) {
      const bool meant = board.empty() || access.values->owner(variable.name) == board;
      if (!meant || !schema::glob_match(name, variable.name)) {
        continue;
      }
      if (auto found = operate::whole(store, variable)) {
        add_item(std::move(found).value(), items);
        any = true;
      }
    }
    if (!any) {
      code =
          unknown(access, name,
                  fmt::format("no variable of {} matches '{}' (indurop vars lists all)", access.values->whose(), name));
    }
  }
  if (code == kOk && values == Values::Needed) {
    std::set<std::string> variables;
    for (const Item& item : items) {
      variables.insert(item.place.variable->name);
    }
    if (const auto missing = access.values->follow(variables); !missing.empty()) {
      access.messages->note(
          fmt::format("no value heard of {} within {}", fmt::join(missing, ", "), human_age(access.remote.wait_ns)));
    }
    code = drop_forbidden(access, items) ? kOk : kFailed;
  }
  return code;
}

JsonValue raw_value(const schema::Type& type, std::span<const std::uint8_t> bytes) {
  return JsonValue::parse(schema::value_to_json(type, bytes)).value_or(JsonValue());
}

std::string range_text(const std::optional<schema::Range>& range) {
  if (!range) {
    return {};
  }
  const auto end = [](double value) { return std::isinf(value) ? std::string() : fmt::format("{}", value); };
  return end(range->min) + ".." + end(range->max);
}

}  // namespace indurop::tools
