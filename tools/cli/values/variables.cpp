// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/values/variables.h"

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
int unknown(Context& context, const std::string& name, const std::string& message) {
  if (const std::string owner = context.values->silent_owner(name); !owner.empty()) {
    context.out.error(fmt::format("'{}' is of board {}, which is silent", name, owner));
    return kUnreachable;
  }
  context.out.error(message);
  const std::string silent = context.values->here() ? std::string() : context.values->absence(nullptr);
  if (silent.empty()) {
    return kFailed;
  }
  context.out.note("it may be of a board that is " + silent);
  return kUnreachable;
}

// Splits "NAME@BOARD". Returns the exit code, after an error message.
int take_board(Context& context, const vars::Store& store, std::string& name, std::string& board) {
  const auto at = name.rfind('@');
  if (context.values->here() || at == std::string::npos) {
    return kOk;
  }
  board = name.substr(at + 1);
  name.resize(at);
  std::string pattern = name;
  if (!is_glob(name)) {
    std::string message;
    const auto place = schema::find_place(store.schema(), name, message);
    pattern = place.ok() ? place.value().variable->name : name;
  }
  const std::string problem = context.values->prefer(pattern, board);
  return problem.empty() ? kOk : unknown(context, name, problem);
}

// Removes the items that the keys do not permit reading. Returns false if these were all.
bool drop_forbidden(Context& context, std::vector<Item>& items) {
  std::set<std::string> forbidden;
  std::erase_if(items, [&](const Item& item) {
    const std::string& variable = item.place.variable->name;
    return context.values->forbidden(variable) && (forbidden.insert(variable), true);
  });
  if (forbidden.empty()) {
    return true;
  }
  const std::string text =
      fmt::format("the keys given by --keys do not let {} be read (indurop keys list -o json shows their lists)",
                  fmt::join(forbidden, ", "));
  if (items.empty()) {
    context.out.error(text);
  } else {
    context.out.note(text);
  }
  return !items.empty();
}

}  // namespace

int select_items(Context& context, const vars::Store& store, const std::vector<std::string>& names,
                 std::vector<Item>& items, Values values) {
  int code = kOk;
  for (std::string name : names) {
    std::string board;
    if (const int refused = take_board(context, store, name, board); refused != kOk) {
      code = refused;
      continue;
    }
    if (!is_glob(name)) {
      auto found = operate::find(store, name);
      if (found) {
        add_item(std::move(found).value(), items);
      } else {
        code = unknown(context, name, found.error().text);
      }
      continue;
    }
    bool any = false;
    for (const auto& variable : store.schema().variables) {
      const bool meant = board.empty() || context.values->owner(variable.name) == board;
      if (!meant || !schema::glob_match(name, variable.name)) {
        continue;
      }
      if (auto found = operate::whole(store, variable)) {
        add_item(std::move(found).value(), items);
        any = true;
      }
    }
    if (!any) {
      code = unknown(
          context, name,
          fmt::format("no variable of {} matches '{}' (indurop vars lists all)", context.values->whose(), name));
    }
  }
  if (code == kOk && values == Values::Needed) {
    std::set<std::string> variables;
    for (const Item& item : items) {
      variables.insert(item.place.variable->name);
    }
    if (const auto missing = context.values->follow(variables); !missing.empty()) {
      context.out.note(
          fmt::format("no value heard of {} within {}", fmt::join(missing, ", "), human_age(context.remote.wait_ns)));
    }
    code = drop_forbidden(context, items) ? kOk : kFailed;
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

std::shared_ptr<const std::vector<std::string>> add_items_to_show(base::Options& app, Context& context) {
  auto names = std::make_shared<std::vector<std::string>>();
  app.add("names", "NAME", *names, "Variables, parts of them (joints[1].y) or globs ('knu::*')")
      .required()
      .completes(base::Completion::Variable);
  add_node_option(app, context);
  add_remote_options(app, context);
  add_format_option(app, context, {Format::Table, Format::Json, Format::Csv});
  return names;
}

}  // namespace indurop::tools
